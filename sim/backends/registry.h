// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Which backends this build has: one row each. The only place that knows them all, and the only one
// that knows their names. A new backend is a row here and two files of its own. Any thread.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "sim/backends/backend_row.h"

namespace scipd::sim {

/// The preferred one comes first.
std::span<const BackendRow> backends();

/// Null where there is no backend of that name.
const BackendRow* find_backend(std::string_view name);

/// Rays, which are exact and quick and need no graphics driver.
const BackendRow& preferred_backend();

/// The one that draws. A build without EGL lists it too, and says why it cannot be made.
const BackendRow& drawing_backend();

/// Throws std::invalid_argument, naming the choices, where there is no backend of that name, and
/// what BackendRow::make throws.
std::unique_ptr<RangeBackend> make_backend(std::string_view name, SharedScene scene,
                                           const DepthOptions& options = {});

}  // namespace scipd::sim
