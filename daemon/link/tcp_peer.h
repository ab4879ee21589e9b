// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Tells whether the other end of a TCP connection is still there: a machine that has lost its power
// or its cable does not say so. While nothing is sent the kernel asks now and then (keepalive), and
// ends the connection where nobody answers. While something is sent stalled() tells. This does not
// use TCP_USER_TIMEOUT: Linux counts that from when the window was first shut until all of the
// segment that waits fits in. For a client that reads, but slowly, this may be never. Waits for
// nothing; one thread.
#pragma once

#include <chrono>
#include <cstdint>

namespace scipd::daemon {

class TcpPeer {
  public:
    /// `socket` must stay open. `bound` is how long a peer may be silent, and is above 0.
    TcpPeer(int socket, std::chrono::nanoseconds bound);

    /// Whether the peer has acknowledged nothing for that long, although something is there for it.
    /// To be asked several times within the bound.
    [[nodiscard]] bool stalled();

  private:
    using Steady = std::chrono::steady_clock;

    int socket_;
    std::chrono::nanoseconds bound_;
    std::uint64_t acknowledged_ = 0;
    Steady::time_point since_ = Steady::now();  ///< nothing was acknowledged
};

}  // namespace scipd::daemon
