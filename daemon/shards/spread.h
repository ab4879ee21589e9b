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
    bool may_move = false;            ///< from where it is held
};

/// The shard of each, below `shards`. What may move does so only where that evens out what there is
/// to do. The same burdens give the same answer.
[[nodiscard]] std::vector<std::size_t> spread(std::span<const Burden> burdens, std::size_t shards);

}  // namespace scipd::daemon
