// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the registry knows of one backend. Rows are constant and live as long as the program; any
// thread.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "sim/backends/depth_options.h"
#include "sim/backends/range_backend.h"

namespace scipd::sim {

/// Whether a machine has what a backend needs.
struct BackendProbe {
    std::string text;  ///< lines for a person
    bool usable = false;
};

struct BackendRow {
    /// What configurations, options and the API call it.
    std::string_view name;
    /// One line for a person, with the library's version where there is one.
    std::string_view description;
    /// It draws pictures of the scene, as DepthOptions say. The first cast of a sensor takes much
    /// longer than those that follow.
    bool draws = false;
    /// It is made to check the others, not for speed.
    bool slow = false;
    /// Looks at this machine; null where the backend works on every machine.
    BackendProbe (*probe)() = nullptr;
    /// A backend that does not draw ignores the options. Throws std::runtime_error with a sentence
    /// where this build or this machine lacks what the backend needs.
    std::unique_ptr<RangeBackend> (*make)(SharedScene scene, const DepthOptions& options) = nullptr;
};

}  // namespace scipd::sim
