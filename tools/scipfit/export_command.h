// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <CLI/CLI.hpp>

namespace scipd::tools {

/// `scipfit export profile.yaml --for amcl|gz|mvsim|stage`: the profile in others' words.
void add_export_command(CLI::App& program);

}  // namespace scipd::tools
