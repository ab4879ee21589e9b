// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// `scipbench lockstep`: its options. One thread.
#pragma once

#include <CLI/CLI.hpp>

namespace scipd::tools {

void add_lockstep(CLI::App& program);

}  // namespace scipd::tools
