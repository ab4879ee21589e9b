// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A file with a secret in its only line, which only its owner may write, and only its group may
// read as well. A file with more than that was made for something else, such as /etc/shadow. Any
// thread; nothing shared.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "sim/expected.h"

namespace scipd::daemon {

/// The only line of the file; if it is longer, its first 4096 bytes.
sim::Expected<std::string> secret_in(const std::filesystem::path& file);

}  // namespace scipd::daemon
