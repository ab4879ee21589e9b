// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a user wants of the link between a device and its client. A value; any thread.
#pragma once

#include <chrono>
#include <optional>

namespace scipd::daemon {

struct LinkConfig {
    /// Each way, on every message; and by how much it varies, evenly, to either side.
    std::chrono::nanoseconds latency{};
    std::chrono::nanoseconds jitter{};
    /// The tty is a serial line that starts at this rate; nothing: USB, whose rate means nothing.
    std::optional<int> baud;
    /// Messages leave in pieces of at most so many bytes, each in a write of its own; 0: whole.
    int split_bytes = 0;
    /// What is sent within so long leaves in one write.
    std::chrono::nanoseconds coalesce{};
    /// A tty's last close ends what was begun on it; else it goes on unheard.
    bool stop_on_close = true;
    /// A TCP client that has not acknowledged anything for so long is gone; 0: never.
    std::chrono::nanoseconds dead_after = std::chrono::seconds(30);

    bool operator==(const LinkConfig&) const = default;
};

}  // namespace scipd::daemon
