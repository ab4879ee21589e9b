// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Completions for shells, written from a program's own commands and options. The daemon and all
// tools use it. Any thread; nothing shared.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace scipd::daemon {

/// The shells that completions() knows.
const std::vector<std::string>& completion_shells();

/// Words that the options do not tell, by place: "/fault/start" is a command, "/--model" an option
/// that wants one of them. A shell runs what stands in $(..) when somebody asks for completions.
using MoreWords = std::map<std::string, std::string>;

/// A script for the shell to read. `shell` is one of completion_shells().
std::string completions(const CLI::App& program, const std::string& shell,
                        const MoreWords& more = {});

}  // namespace scipd::daemon
