// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// `scipd --check`: a configuration, its world, its trajectories and whether this machine has what
// it asks for, without running any of it; or one of the files that a configuration names. One
// thread.
#pragma once

#include <filesystem>
#include <string>

#include "daemon/program/run_options.h"

namespace scipd::daemon {

/// `options` as they would be given to run it. Warnings and what there is, for a person. Throws
/// LoadError with every fault of all the files that a sound configuration names.
std::string check(const std::filesystem::path& file, const Options& options = Options());

}  // namespace scipd::daemon
