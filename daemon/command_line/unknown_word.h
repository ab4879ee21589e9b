// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace scipd::daemon {

/// What to tell of the first word of a command line that means nothing: the option that it could
/// be, or the command. Nothing where every word means something. `program` has tried to parse it.
std::optional<std::string> unknown_word(const CLI::App& program);

}  // namespace scipd::daemon
