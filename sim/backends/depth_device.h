// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where depth can be drawn on this machine: the first place of EGL that draws a picture of known
// triangles as it must be. Graphics devices come before the processor.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "sim/backends/depth.h"
#include "sim/backends/egl_context.h"

namespace scipd::sim {

/// Shared by all depth backends that are made on the calling thread, as long as one of them lives
/// and until one leaves the thread: then all of them do. Throws std::runtime_error that says of
/// every place why not.
std::shared_ptr<EglContext> depth_context();

/// Draws the picture and compares depths and numbers. Nothing where all is right, else a sentence.
std::optional<std::string> failure_of_self_test(const std::shared_ptr<EglContext>& context);

/// Every place, what it says of itself and whether it can be used, as lines for a person.
DepthProbe probe_depth_devices();

}  // namespace scipd::sim
