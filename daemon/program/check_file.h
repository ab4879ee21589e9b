// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// `scipd --check` of a file that is no configuration: what it holds, without running any of it. Any
// thread; nothing shared.
#pragma once

#include <filesystem>
#include <string>

#include "daemon/config/file_kind.h"
#include "daemon/program/run_options.h"

namespace scipd::daemon {

/// Warnings and what there is, for a person. `overrides` say how a world is read, and if they are
/// strict, what it or a trajectory would cause a warning for is a fault. Throws LoadError with
/// every fault.
std::string check_file(FileKind kind, const std::filesystem::path& file,
                       const Overrides& overrides);

}  // namespace scipd::daemon
