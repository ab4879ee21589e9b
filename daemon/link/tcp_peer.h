// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Whether the other end of a TCP connection is still there: a machine that has lost its power or
// its cable does not say so. Where nothing is sent, the kernel asks now and then (keepalive), and
// ends the connection where nobody answers. Where something is sent, stalled() tells. Not
// TCP_USER_TIMEOUT: Linux counts its time from when the window was first shut until all of the
// segment that waits fits in, which may be never for one that reads slowly, but does read. Waits
// for nothing; one thread.
#pragma once

#include <chrono>
#include <cstdint>

namespace scipd::daemon {

class TcpPeer {
  public:
    /// `socket` must stay open. Above 0, `bound` is how long a peer may be silent.
    TcpPeer(int socket, std::chrono::nanoseconds bound);

    /// For so long it has acknowledged nothing of what is there for it. To be asked several times
    /// within the bound.
    [[nodiscard]] bool stalled();

  private:
    using Steady = std::chrono::steady_clock;

    int socket_;
    std::chrono::nanoseconds bound_;
    std::uint64_t acknowledged_ = 0;
    Steady::time_point since_ = Steady::now();  ///< nothing has been
};

}  // namespace scipd::daemon
