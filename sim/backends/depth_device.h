// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Finds where depth can be drawn on this machine: the first place of EGL that draws a picture of
// known triangles correctly. Graphics devices come before the processor.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "sim/backends/egl_context.h"

namespace scipd::sim {

/// The context that all depth backends share which are made on the calling thread. It lives as long
/// as one of them, and they all leave the thread together. Throws std::runtime_error that says for
/// every place why nothing can be drawn there.
std::shared_ptr<EglContext> depth_context();

/// Draws the picture and compares depths and triangle numbers. Returns a sentence where some are
/// wrong, else nothing.
std::optional<std::string> failure_of_self_test(const std::shared_ptr<EglContext>& context);

}  // namespace scipd::sim
