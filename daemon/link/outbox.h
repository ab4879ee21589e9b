// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Messages on their way to one client, oldest first: those that wait and those that are under way
// on the link. Their bytes are bounded: where the client or the line is too slow, the outbox
// refuses whole scans; it never refuses a reply. One thread.
#pragma once

#include <cstddef>
#include <utility>

#include "daemon/link/link_model.h"
#include "protocol/action.h"

namespace scipd::daemon {

class Outbox {
  public:
    /// About two seconds of a UST-10LX at 40 Hz, on top of what the kernel holds.
    static constexpr std::size_t usual_capacity_bytes = 256 * 1024;
    /// A serial line takes longer for a scan than the scanner does. There is room for one scan of a
    /// URG-04LX while another is on the line, so that an answer is never more than two scans away.
    static constexpr std::size_t serial_capacity_bytes = 5 * 1024;

    explicit Outbox(LinkModel line, std::size_t capacity_bytes = usual_capacity_bytes)
        : line_(std::move(line)), capacity_bytes_(capacity_bytes) {}

    /// False: it was a scan, there was no room, and it is gone.
    bool push(protocol::Send message, sim::Time now);
    /// Whether no more requests should be read, since their answers would add to it.
    [[nodiscard]] bool full() const { return line_.bytes() >= capacity_bytes_; }
    [[nodiscard]] bool half_full() const { return line_.bytes() >= capacity_bytes_ / 2; }

    /// Where all that was pushed comes out.
    [[nodiscard]] LinkModel& line() { return line_; }

  private:
    LinkModel line_;
    std::size_t capacity_bytes_;
};

}  // namespace scipd::daemon
