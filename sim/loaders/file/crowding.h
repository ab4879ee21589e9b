// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Refuses a place in which so many triangles lie that no scanner could look at it in time. Any
// thread.
#pragma once

#include <cstddef>
#include <string>

#include "sim/world/scene.h"

namespace scipd::sim {

/// Throws LoadError, which begins with `source`, where `added` has made a place in the scene in
/// which a ray would be tested against more than `most` triangles. `added` may be the scene itself.
void check_overlap(const Scene& scene, const Scene& added, const std::string& source,
                   std::size_t most);

}  // namespace scipd::sim
