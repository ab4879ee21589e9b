// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Which sensor lives on which shard, so that all shards have about as much to do. Values; any
// thread.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace scipd::daemon {

/// What decides where a sensor lives.
struct Burden {
    double cost = 0.0;                ///< in any unit, the same for all
    std::optional<std::size_t> held;  ///< by what lives there already
};

/// The shard of each, below `shards`: what is held stays, and the others go where there is least to
/// do. The same burdens give the same answer.
[[nodiscard]] std::vector<std::size_t> spread(std::span<const Burden> burdens, std::size_t shards);

}  // namespace scipd::daemon
