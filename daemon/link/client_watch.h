// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Is told of the clients that come to a port and leave it. Lives on the shard of the port.
#pragma once

#include <string>

#include "protocol/refusal.h"

namespace scipd::daemon {

/// Why a client is no longer connected.
enum class Leaving {
    closed,  ///< by the client
    cut,     ///< by a fault
    silent,  ///< its machine no longer answers
    booted,  ///< the scanner boots
    ended,   ///< the scanner behind the port goes
};

class ClientWatch {
  public:
    virtual ~ClientWatch() = default;

    /// `from`: HOST:PORT of a TCP client; empty: it has opened the tty.
    virtual void came(const std::string& from) = 0;
    /// A TCP client that comes in while another one, `served`, is connected.
    virtual void waits(const std::string& from, const std::string& served) = 0;
    virtual void left(protocol::LinkKind from, Leaving why) = 0;
};

}  // namespace scipd::daemon
