// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The stage for tests that every backend has to pass: each runs in a world around its origin and in
// one that lies 10 km away from it and is turned. What a test says of places, it says in a frame T
// of its own.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <ostream>
#include <span>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "sim/backends/registry.h"
#include "tests/support/scene_builder.h"

namespace scipd::sim {

/// What is promised up to 60 m.
inline constexpr double range_tolerance_m = 1e-3;
inline constexpr float nothing = std::numeric_limits<float>::infinity();

inline std::vector<std::string> backend_names() {
    std::vector<std::string> names;
    for (const BackendRow& backend : backends())
        names.emplace_back(backend.name);
    return names;
}

/// Why a backend that this build lists cannot be had here: in a build or on a machine without EGL,
/// say. Empty where it can.
inline std::string what_lacks(const std::string& name) {
    try {
        make_backend(name, SceneBuilder().build());
        return {};
    } catch (const std::runtime_error& error) {
        return error.what();
    }
}

enum class Place { origin, far_away };

/// For GoogleTest, which names tests by what it prints.
inline void PrintTo(Place place, std::ostream* out) {  // NOLINT(readability-identifier-naming)
    *out << (place == Place::origin ? "at the origin" : "far away");
}

class Contract : public testing::TestWithParam<std::tuple<std::string, Place>> {
  protected:
    void SetUp() override {
        if (const auto why = what_lacks(std::get<0>(GetParam())); !why.empty()) GTEST_SKIP() << why;
    }

    [[nodiscard]] SceneBuilder scene() const { return SceneBuilder(world_from_test_); }

    void load(const SceneBuilder& scene) {
        backend_ = make_backend(std::get<0>(GetParam()), scene.build());
    }

    [[nodiscard]] RangeBackend& backend() const { return *backend_; }

    void move(ModelId model, const Pose& test_from_model) {
        backend_->move(model, world_from_test_ * test_from_model);
    }

    std::vector<Hit> cast(const std::vector<glm::vec3>& directions, std::vector<Pose> poses,
                          float max_range_m = nothing, const Unseen& unseen = {},
                          std::optional<std::span<const ModelId>> can_meet = std::nullopt) {
        for (Pose& pose : poses)
            pose = world_from_test_ * pose;
        std::vector<Hit> hits(directions.size());
        backend_->cast({directions, poses, max_range_m, unseen, can_meet}, hits);
        return hits;
    }

    Hit cast_one(const glm::vec3& direction, const Pose& test_from_sensor = {},
                 float max_range_m = nothing) {
        return cast({direction}, {test_from_sensor}, max_range_m).front();
    }

  private:
    Pose world_from_test_ = std::get<1>(GetParam()) == Place::origin
                                ? Pose{}
                                : pose_from_rpy({-10'000, 7'000, 120}, {0.1, -0.2, 2.0});
    std::unique_ptr<RangeBackend> backend_;
};

inline auto every_backend_everywhere() {
    return testing::Combine(testing::ValuesIn(backend_names()),
                            testing::Values(Place::origin, Place::far_away));
}

inline std::string contract_name(const testing::TestParamInfo<Contract::ParamType>& test) {
    return std::get<0>(test.param) +
           (std::get<1>(test.param) == Place::origin ? "_at_the_origin" : "_far_away");
}

}  // namespace scipd::sim
