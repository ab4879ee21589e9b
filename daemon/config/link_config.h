// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a user wants of the link between a device and its client. A value; any thread.
#pragma once

#include <chrono>
#include <optional>
#include <vector>

namespace scipd::daemon {

struct LinkConfig {
    /// How late every message arrives, each way; and by how much that varies to either side, evenly
    /// distributed.
    std::chrono::nanoseconds latency{};
    std::chrono::nanoseconds jitter{};
    /// The tty is a serial line that starts at this rate. Nothing: it is USB, where a rate means
    /// nothing.
    std::optional<int> baud;
    /// Messages leave in pieces of at most so many bytes, each in a write of its own; 0: whole.
    int split_bytes = 0;
    /// Messages that are sent within this time leave in one write.
    std::chrono::nanoseconds coalesce{};
    /// Whether the streams of a tty end when it is closed by the last program that has it open.
    bool stop_on_close = true;
    /// A TCP client that has acknowledged nothing for this long counts as gone; 0: never.
    std::chrono::nanoseconds dead_after = std::chrono::seconds(30);

    // What only faults ask for.

    /// Messages are split before these of their bytes as well.
    std::vector<int> split_at = {};
    /// So much later than a piece leaves the next one of its message.
    std::chrono::nanoseconds split_pause{};

    bool operator==(const LinkConfig&) const = default;
};

}  // namespace scipd::daemon
