// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A place where clients connect to a scanner, one at a time: a TCP port or a tty. It outlives the
// scanner behind it, and can be handed to another one. Lives on the I/O thread.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "daemon/config/link_config.h"
#include "daemon/link/connection.h"
#include "daemon/link/endpoint.h"

namespace scipd::daemon {

class Port {
  public:
    Port() = default;
    Port(const Port&) = delete;
    Port& operator=(const Port&) = delete;
    virtual ~Port() = default;

    /// Gets all that the next serve() needs, so that serve() does not fail. Throws
    /// std::system_error; then all is as before.
    virtual void prepare() = 0;
    /// Whoever connects from now on talks to this scanner, over a link like this; who is connected
    /// is cut off. The scanner must live until the next serve() or stop().
    virtual void serve(Endpoint& scanner, const LinkConfig& link) = 0;
    /// Cuts off who is connected, and is no place to connect to any more.
    virtual void stop() = 0;

    /// What a client connects to: HOST:PORT with the port that was really taken, or the path of the
    /// tty's link.
    [[nodiscard]] virtual std::string address() const = 0;
    [[nodiscard]] virtual bool connected() const = 0;
    /// Scans that clients read too slowly for, since the port was made.
    [[nodiscard]] std::uint64_t lost_scans() const;

  protected:
    void begin(std::shared_ptr<Connection> connection);
    /// Cuts off who is connected.
    void end_connection();
    /// Null: there is none.
    [[nodiscard]] Connection* connection() const { return connection_.get(); }

  private:
    std::shared_ptr<Connection> connection_;
    std::uint64_t lost_before_ = 0;  ///< by connections that have ended
};

}  // namespace scipd::daemon
