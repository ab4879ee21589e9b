// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Ranges from a depth buffer: the scene is drawn from the sensor, depths and triangle numbers are
// read back, and every beam looks up the pixels around it. Needs EGL and OpenGL 4.5 when it runs,
// with or without a graphics device. In a build without them no_depth.cpp stands in.
//
// A run of directions with one pose is drawn at once; a pose for each beam is a picture for each
// beam, which costs accordingly. The context of OpenGL is shared by all depth backends that are
// made on one thread together: they leave it together, too.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "sim/backends/depth_options.h"
#include "sim/backends/range_backend.h"

namespace scipd::sim {

[[nodiscard]] std::string_view depth_description();

/// Throws std::runtime_error with a sentence where this build or this machine cannot draw, and so
/// does a cast where a driver fails later.
std::unique_ptr<RangeBackend> make_depth_backend(SharedScene scene,
                                                 const DepthOptions& options = {});

/// Settings for drivers that read them from the environment. Backends see to it themselves; a
/// program with threads calls this before it has any, since changing the environment is for one
/// alone.
void prepare_drivers();

struct DepthProbe {
    std::string text;  ///< what this machine's EGL offers, for a person
    bool can_draw = false;
};

DepthProbe probe_depth();

}  // namespace scipd::sim
