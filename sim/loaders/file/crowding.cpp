// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/file/crowding.h"

#include <array>
#include <cstdio>

#include "sim/loaders/file/load_error.h"
#include "sim/world/overlap.h"

namespace scipd::sim {

void check_overlap(const Scene& scene, const Scene& added, const std::string& source,
                   std::size_t most) {
    const auto worst = worst_overlap(scene, added, double(most));
    if (!worst) return;
    const glm::dvec3& at_m = worst->middle_m;
    std::array<char, 400> text{};
    std::snprintf(text.data(), text.size(),
                  ": near (%.4g %.4g %.4g) so many triangles lie in one place that a ray would be "
                  "tested against %.0f of them, and scans would be lost; take away what is there "
                  "more than once, or thin it out; world_overlap under limits in the "
                  "configuration allows more than %zu",
                  at_m.x, at_m.y, at_m.z, worst->triangles, most);
    throw LoadError({source + ": " + worst->object + text.data()});
}

}  // namespace scipd::sim
