// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Rays through Embree, in packets of 16. The static models are one scene that is built once; each
// movable model is an instance in a second scene, which is traced after the first and as far as the
// first one's hits only.
#pragma once

#include <memory>
#include <string_view>

#include "sim/backends/range_backend.h"

namespace scipd::sim {

/// With the version of the library.
[[nodiscard]] std::string_view embree_description();

/// Throws std::runtime_error where Embree has no memory for the scene.
std::unique_ptr<RangeBackend> make_embree_backend(SharedScene scene);

}  // namespace scipd::sim
