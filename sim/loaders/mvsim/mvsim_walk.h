// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The way through an MVSim world and the files that it includes: loops, conditions, variables and
// classes are followed, everything else is handed on. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "sim/loaders/mvsim/mvsim_node.h"

namespace scipd::sim {

struct MvsimVisitor {
    /// What is no loop, class or variable; lives during the call. What it throws as
    /// std::invalid_argument is told to `leave_out`, with its place.
    std::function<void(const MvsimNode& node)> visit;
    std::function<void(const std::string& what)> leave_out;
    /// The text of an included file; nothing where it is not there.
    std::function<std::optional<std::string>(const std::filesystem::path& file)> read;
};

/// Throws LoadError where this is no world of MVSim, or where it would never end.
void walk_mvsim(const std::string& text, const std::filesystem::path& file,
                const MvsimVisitor& visitor);

}  // namespace scipd::sim
