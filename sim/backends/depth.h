// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Ranges from a depth buffer. The scene is drawn as the sensor sees it, depths and triangle numbers
// are read back, and every beam looks up the pixels around it. This needs EGL and OpenGL 4.5 at run
// time, with or without a graphics device. In a build without them no_depth.cpp stands in.
//
// Directions that follow each other and share a pose are drawn at once. Where each beam has a pose
// of its own, each beam needs a picture, which costs accordingly. All depth backends that are made
// on one thread share a context of OpenGL; they leave the thread together, too.
#pragma once

#include <memory>
#include <string_view>

#include "sim/backends/depth_options.h"
#include "sim/backends/range_backend.h"

namespace scipd::sim {

[[nodiscard]] std::string_view depth_description();

/// Throws std::runtime_error with a sentence where this build or this machine cannot draw. A cast
/// throws it where a driver fails later.
std::unique_ptr<RangeBackend> make_depth_backend(SharedScene scene,
                                                 const DepthOptions& options = {});

/// Sets what drivers read from the environment. Backends do so themselves. A program with several
/// threads calls this before it starts them, since only a single thread may change the environment.
void prepare_drivers();

}  // namespace scipd::sim
