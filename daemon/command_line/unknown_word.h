// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <functional>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace scipd::daemon {

/// Text to use instead of an unknown word, such as "--scene room.sdf" for "room.sdf"; empty: none.
using Replacement = std::function<std::string(const std::string& word)>;

/// Error message for the first unknown word of a command line, with the option or command that was
/// probably meant. Returns nullopt if every word is known. `program` has tried to parse the line.
std::optional<std::string> unknown_word(const CLI::App& program,
                                        const Replacement& replacement = {});

/// Names of the commands that can follow what was typed; empty if none can.
std::string commands_after(const CLI::App& program);

}  // namespace scipd::daemon
