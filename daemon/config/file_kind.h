// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a file is that somebody hands over without saying so. Any thread; nothing shared.
#pragma once

#include <filesystem>

#include "sim/expected.h"

namespace scipd::daemon {

enum class FileKind { configuration, scenario, materials, map, world, mesh, trajectory };

/// By its extension, and where several kinds have that, or it has none, by its content. A
/// configuration also where its keys are misspelt. The fault lists what there could be.
[[nodiscard]] sim::Expected<FileKind> kind_of(const std::filesystem::path& file);

}  // namespace scipd::daemon
