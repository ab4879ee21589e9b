// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <CLI/CLI.hpp>

#include "daemon/command_line/completions.h"

namespace scipd::tools {

/// `PROGRAM completion bash|zsh|fish`, which all tools have.
void add_completion_command(CLI::App& program, const daemon::MoreWords& more = {});

}  // namespace scipd::tools
