// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Worlds from SDF with one beam at a time cast into them by a backend of choice, for tests.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "sim/backends/registry.h"
#include "sim/loaders/sdf/sdf.h"
#include "tests/support/temp_dir.h"

namespace scipd::sim {

/// The parameter is the name of a backend.
class SdfCast : public ::testing::TestWithParam<const char*> {
  protected:
    static constexpr auto nothing = std::numeric_limits<float>::infinity();

    void load(const std::string& text, const SdfOptions& options = {}) {
        auto loaded = load_sdf(folder_.write("a.sdf", text), options);
        scene_ = std::move(loaded.scene);
        warnings_ = std::move(loaded.warnings);
        backend_ = make_backend(GetParam(), scene_);
    }

    float range_m(const glm::dvec3& from, const glm::dvec3& along) {
        const glm::vec3 direction{along};
        const Pose pose{from, {1.0, 0.0, 0.0, 0.0}};
        Hit hit;
        backend_->cast({.directions = {&direction, 1}, .world_from_sensor = {&pose, 1}}, {&hit, 1});
        return hit.range_m;
    }

    /// From 10 m above.
    float down_m(double x, double y) { return range_m({x, y, 10.0}, {0, 0, -1}); }

    tests::TempDir folder_;
    SharedScene scene_;
    std::vector<std::string> warnings_;
    std::unique_ptr<RangeBackend> backend_;
};

inline std::string name_of_backend(const ::testing::TestParamInfo<const char*>& backend) {
    return backend.param;
}

}  // namespace scipd::sim
