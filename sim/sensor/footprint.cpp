// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/footprint.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <vector>

namespace scipd::sim {
namespace {

/// The light at radius r, in halves of the footprint, is exp(-2 r²): with s = 2 r² the weight of
/// Laguerre's polynomials, exp(-s), whose first moments are 1 and 2.
struct Ring {
    double s;
    double weight;  ///< of all six
};

constexpr int rays_per_ring = 6;
/// Each ring is turned by this, so that no two of its rays stand above or beside each other: a wire
/// then meets one of them at twice as many places.
constexpr double turned_rad = std::numbers::pi / 12;

std::vector<FootprintRay> rays_of(double middle_weight, std::span<const Ring> rings) {
    std::vector<FootprintRay> rays{{0.0, 0.0, static_cast<float>(middle_weight)}};
    for (const Ring& ring : rings) {
        const double radius = std::sqrt(0.5 * ring.s);
        for (int i = 0; i < rays_per_ring; ++i) {
            const double angle_rad = turned_rad + 2.0 * std::numbers::pi * i / rays_per_ring;
            rays.push_back({radius * std::cos(angle_rad), radius * std::sin(angle_rad),
                            static_cast<float>(ring.weight / rays_per_ring)});
        }
    }
    return rays;
}

/// The radii leave the least gaps between the rays, seen from above and from the side; the weights
/// then follow from both moments.
std::vector<FootprintRay> thirteen_rays() {
    constexpr double near = 0.85;
    constexpr double far = 2.6;
    constexpr double near_weight = (far - 2.0) / (near * (far - near));
    constexpr double far_weight = (2.0 - near) / (far * (far - near));
    return rays_of(1.0 - near_weight - far_weight,
                   std::array<Ring, 2>{{{near, near_weight}, {far, far_weight}}});
}

}  // namespace

double Footprint::reach_rad() const {
    double reach_rad = 0.0;
    for (const FootprintRay& ray : footprint_rays(rays)) {
        reach_rad =
            std::max(reach_rad, std::hypot(ray.across * half_width_rad, ray.up * half_height_rad));
    }
    return reach_rad;
}

std::span<const FootprintRay> footprint_rays(int rays) {
    static const std::vector<FootprintRay> one = rays_of(1.0, {});
    static const std::vector<FootprintRay> seven = rays_of(0.5, std::array<Ring, 1>{{{2.0, 0.5}}});
    static const std::vector<FootprintRay> thirteen = thirteen_rays();
    assert(rays == 1 || rays == 7 || rays == 13);
    return rays == 1 ? one : rays == 7 ? seven : thirteen;
}

}  // namespace scipd::sim
