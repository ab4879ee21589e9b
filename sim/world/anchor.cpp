// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/world/anchor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "sim/world/bounds.h"

namespace scipd::sim {
namespace {

/// Up to here floats are less than 0.1 mm apart.
constexpr double near_m = 1000.0;

double largest(const glm::dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// Planes, which are exact at any distance, count only where there is nothing else.
std::vector<Bounds> bounds_that_count(const Scene& scene) {
    std::vector<Bounds> things;
    std::vector<Bounds> planes;
    for (const Object& object : scene.objects) {
        const Bounds bounds = bounds_in_world(scene, object);
        if (bounds.empty()) continue;
        (std::holds_alternative<Plane>(object.shape) ? planes : things).push_back(bounds);
    }
    return things.empty() ? planes : things;
}

/// In each coordinate as many of the points lie on one side as on the other.
glm::dvec3 median(const std::vector<glm::dvec3>& points_m) {
    glm::dvec3 result{0.0};
    std::vector<double> values(points_m.size());
    for (int axis = 0; axis < 3; ++axis) {
        std::ranges::transform(points_m, values.begin(),
                               [axis](const glm::dvec3& point) { return point[axis]; });
        const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
        std::ranges::nth_element(values, middle);
        result[axis] = *middle;
    }
    return result;
}

Bounds bounds_of_most(const std::vector<Bounds>& all) {
    // The origin has a voice too: of two things that lie far apart, the one that is near it counts.
    std::vector<glm::dvec3> middles_m{glm::dvec3{0.0}};
    for (const Bounds& bounds : all)
        middles_m.push_back(bounds.middle_m());
    const glm::dvec3 most_m = median(middles_m);
    Bounds result;
    for (const Bounds& bounds : all) {
        if (glm::distance(bounds.middle_m(), most_m) <= near_m) result.include(bounds, Pose{});
    }
    if (result.empty()) result.include(most_m);
    return result;
}

/// The distance from one float to the next.
double spacing_m(double distance_m) {
    const auto here = static_cast<float>(distance_m);
    return double{std::nextafter(here, std::numeric_limits<float>::infinity())} - double{here};
}

}  // namespace

glm::dvec3 anchor_of(const Scene& scene) {
    const std::vector<Bounds> all = bounds_that_count(scene);
    if (all.empty()) return glm::dvec3{0.0};
    Bounds whole;
    for (const Bounds& bounds : all)
        whole.include(bounds, Pose{});
    const bool is_small = largest(whole.high_m - whole.low_m) <= 2.0 * near_m;
    return glm::round((is_small ? whole : bounds_of_most(all)).middle_m());
}

std::optional<Coarseness> coarsest(const Scene& scene, double tolerable_m) {
    std::optional<Coarseness> worst;
    for (ObjectId id = 0; id < scene.objects.size(); ++id) {
        const Object& object = scene.objects[id];
        const Bounds bounds = bounds_in_world(scene, object);
        if (bounds.empty() || std::holds_alternative<Plane>(object.shape)) continue;
        const double distance_m = std::max(largest(bounds.low_m - scene.anchor_m),
                                           largest(bounds.high_m - scene.anchor_m));
        if (worst && distance_m <= worst->distance_m) continue;
        worst = {id, distance_m, spacing_m(distance_m)};
    }
    if (!worst || worst->error_m <= tolerable_m) return std::nullopt;
    return worst;
}

}  // namespace scipd::sim
