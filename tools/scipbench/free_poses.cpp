// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipbench/free_poses.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>

#include "sim/world/bounds.h"

namespace scipd::tools {
namespace {

constexpr int beams = 64;
constexpr float elbow_room_m = 0.2F;

std::vector<glm::vec3> all_round() {
    std::vector<glm::vec3> directions;
    for (int i = 0; i < beams; ++i) {
        const double angle_rad = 2.0 * std::numbers::pi * i / beams;
        directions.emplace_back(std::cos(angle_rad), std::sin(angle_rad), 0.0);
    }
    return directions;
}

bool can_stand(const std::vector<sim::Hit>& hits) {
    return std::ranges::all_of(hits,
                               [](const sim::Hit& hit) { return hit.range_m > elbow_room_m; }) &&
           std::ranges::count_if(hits, &sim::Hit::met) > beams / 2;
}

std::string no_place(double height_m, const std::string& scene) {
    std::ostringstream text;
    text << "the scene " << scene << " has no place to stand " << height_m
         << " m high; try another --height";
    return text.str();
}

}  // namespace

std::vector<sim::Pose> free_poses(sim::RangeBackend& rays, std::size_t count, double height_m) {
    const sim::Scene& scene = rays.scene();
    sim::Bounds bounds;
    for (const sim::Object& object : scene.objects) {
        bounds.include(sim::bounds_of(object.shape),
                       scene.models[object.model].world_from_model * object.model_from_object);
    }
    std::mt19937 rng(7);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(rng);
    };
    const auto directions = all_round();
    std::vector<sim::Hit> hits(directions.size());
    std::vector<sim::Pose> poses;
    for (std::size_t tries = 0; poses.size() < count; ++tries) {
        if (bounds.empty() || tries > 1000 * (count + 1))
            throw std::runtime_error(no_place(height_m, scene.name));
        const glm::dvec3 place{between(bounds.low_m.x, bounds.high_m.x),
                               between(bounds.low_m.y, bounds.high_m.y), height_m};
        const sim::Pose pose = sim::pose_from_rpy(
            place, {between(-0.01, 0.01), between(-0.01, 0.01), between(0, 2 * std::numbers::pi)});
        rays.cast({directions, {&pose, 1}}, hits);
        if (can_stand(hits)) poses.push_back(pose);
    }
    return poses;
}

}  // namespace scipd::tools
