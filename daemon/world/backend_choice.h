// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What casts for a sensor, and why. Values; any thread.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "sim/backends/backend_row.h"

namespace scipd::daemon {

struct BackendChoice {
    std::string backend;  ///< its name in the registry
    std::string reason;   ///< why `auto` takes it; empty where the user named it
    /// How large the scene was in which `auto` was measured; nothing where it was not measured.
    std::optional<std::size_t> faces;
};

using SharedChoice = std::shared_ptr<const BackendChoice>;

/// The preferred backend, which nobody has measured: where two runs have to be the same, and until
/// there is time to measure.
SharedChoice unmeasured_choice(std::string why);

/// What a user can do where this backend cannot be made: the end of a sentence, or nothing.
std::string advice_instead_of(const sim::BackendRow& backend);

}  // namespace scipd::daemon
