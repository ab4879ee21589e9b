// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Walks through an MVSim world and the files that it includes. It follows loops, conditions,
// variables and classes, and passes all other elements on. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "sim/loaders/mvsim/mvsim_node.h"

namespace scipd::sim {

struct MvsimVisitor {
    /// Gets each element that is passed on; the node is valid during the call. If this throws
    /// std::invalid_argument, `leave_out` gets the message with the element's place.
    std::function<void(const MvsimNode& node)> visit;
    std::function<void(const std::string& what)> leave_out;
    /// The text of an included file; nothing if it does not exist.
    std::function<std::optional<std::string>(const std::filesystem::path& file)> read;
};

/// Throws LoadError if the text is no world of MVSim, or if the walk would never end.
void walk_mvsim(const std::string& text, const std::filesystem::path& file,
                const MvsimVisitor& visitor);

}  // namespace scipd::sim
