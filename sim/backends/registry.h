// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Which backends this build has, by name. The only place that knows them all.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "sim/backends/range_backend.h"

namespace scipd::sim {

struct BackendInfo {
    std::string_view name;
    /// One line for a person, with the library's version where there is one.
    std::string_view description;
};

/// What make_backend() accepts, the preferred one first; "auto" stands for that one and is not
/// listed.
std::span<const BackendInfo> backends();

/// Throws std::invalid_argument, naming the choices, where there is no backend of that name, and
/// std::runtime_error where this build or this machine has not what it needs.
std::unique_ptr<RangeBackend> make_backend(std::string_view name, SharedScene scene);

}  // namespace scipd::sim
