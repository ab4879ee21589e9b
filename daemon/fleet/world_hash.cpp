// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/fleet/world_hash.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <variant>

#include "sim/fnv1a.h"
#include "sim/world/script.h"

namespace scipd::daemon {
namespace {

class Mixer {
  public:
    // A word at a time: a world has many vertices.
    void add(std::uint64_t word) {
        state_ = (std::rotl(state_, 5) ^ word) * 0x9E3779B97F4A7C15ULL;
        state_ ^= state_ >> 32U;
    }
    void add(const std::string& text) { add(sim::fnv1a<std::uint64_t>(text)); }
    void add(double number) {
        constexpr double most = 1e12;
        add(static_cast<std::uint64_t>(std::llround(std::clamp(number, -most, most) * 1e6)));
    }
    void add(const glm::dvec3& v) {
        for (const double x : {v.x, v.y, v.z})
            add(x);
    }
    void add(const sim::Pose& pose) {
        add(pose.translation_m);
        for (const double x : {pose.rotation.x, pose.rotation.y, pose.rotation.z, pose.rotation.w})
            add(x);
    }

    void add(const sim::Box& box) { add(box.size_m); }
    void add(const sim::Cylinder& cylinder) {
        add(cylinder.radius_m);
        add(cylinder.length_m);
    }
    void add(const sim::Sphere& sphere) { add(sphere.radius_m); }
    void add(const sim::Plane& plane) {
        add(plane.size_m.x);
        add(plane.size_m.y);
    }
    void add(const sim::SharedMesh& mesh) {
        for (const glm::vec3& vertex : mesh->vertices_m)
            add(glm::dvec3(vertex));
        for (const glm::uvec3& triangle : mesh->triangles) {
            add(std::uint64_t{triangle.x} << 32U | triangle.y);
            add(std::uint64_t{triangle.z});
        }
    }

    [[nodiscard]] std::uint64_t state() const { return state_; }

  private:
    std::uint64_t state_ = 1;
};

void add(Mixer& mixer, const sim::Model& model) {
    mixer.add(model.name);
    mixer.add(std::uint64_t{model.movable});
    mixer.add(model.world_from_model);
    if (!model.script) return;
    mixer.add(static_cast<std::uint64_t>(model.script->lap.count()));
    for (const sim::Script::Step& step : model.script->steps) {
        mixer.add(static_cast<std::uint64_t>(step.time.count()));
        mixer.add(step.pose);
    }
}

}  // namespace

std::string content_hash(const sim::Scene& scene) {
    Mixer mixer;
    for (const sim::Model& model : scene.models)
        add(mixer, model);
    for (const sim::Object& object : scene.objects) {
        mixer.add(std::uint64_t{object.model});
        mixer.add(object.model_from_object);
        mixer.add(scene.materials[object.material].name);
        mixer.add(std::uint64_t{object.shape.index()});
        std::visit([&](const auto& shape) { mixer.add(shape); }, object.shape);
    }
    std::array<char, 17> digits{};
    std::snprintf(digits.data(), digits.size(), "%016llx",
                  static_cast<unsigned long long>(mixer.state()));
    return digits.data();
}

}  // namespace scipd::daemon
