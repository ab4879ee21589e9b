// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Messages on their way to one client, oldest first. Bounded: where the client reads too slowly,
// scans are dropped whole and counted; replies never are. One thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>

#include "protocol/action.h"

namespace scipd::daemon {

class Outbox {
  public:
    /// About two seconds of a UST-10LX at 40 Hz, on top of what the kernel holds.
    static constexpr std::size_t capacity_bytes = 256 * 1024;

    /// False: it was a scan, there was no room, and it is gone.
    bool push(protocol::Send message);
    /// No request should be read that would add to it.
    [[nodiscard]] bool full() const { return bytes_ >= capacity_bytes; }
    [[nodiscard]] bool empty() const { return messages_.empty(); }

    /// Takes the oldest out.
    [[nodiscard]] std::string pop();
    void clear();

  private:
    std::deque<std::string> messages_;
    std::size_t bytes_ = 0;
};

}  // namespace scipd::daemon
