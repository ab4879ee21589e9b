// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Rays through Embree, in packets of 16. The static models are one scene, which is built once. Each
// movable model is an instance in a second scene. That one is traced after the first, and only up
// to the hits of the first.
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
