// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A file with a secret in its first line, which only its owner and its group may read. Any thread;
// nothing shared.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "sim/expected.h"

namespace scipd::daemon {

/// Longer lines are cut behind their 1025th byte.
sim::Expected<std::string> secret_in(const std::filesystem::path& file);

}  // namespace scipd::daemon
