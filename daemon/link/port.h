// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A place where clients connect to a scanner, one at a time: a TCP port or a tty. It outlives the
// scanner behind it, and can be handed to another one. Lives on its shard.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "daemon/config/link_config.h"
#include "daemon/limits/limits.h"
#include "daemon/link/client_watch.h"
#include "daemon/link/connection.h"
#include "daemon/link/endpoint.h"
#include "daemon/link/line_hook.h"
#include "daemon/link/link_counts.h"

namespace scipd::daemon {

/// How a TCP connection ends: as if its program had closed it, or with a reset.
enum class Cut { fin, rst };

class Port {
  public:
    Port() = default;
    Port(const Port&) = delete;
    Port& operator=(const Port&) = delete;
    virtual ~Port() = default;

    /// What holds for all who connect from now on; before, the usual limits do.
    void hold_to(SharedLimits limits) { limits_ = std::move(limits); }
    /// Gets all that the next serve() needs, so that serve() does not fail. Throws
    /// std::system_error; then all is as before.
    virtual void prepare() = 0;
    /// Whoever connects from now on talks to this scanner, over a link like this; who is connected
    /// is cut off: a TCP connection is closed, a tty hangs up and comes back under its name. The
    /// line is like its link again. The scanner must live until the next serve() or stop().
    virtual void serve(Endpoint& scanner, const LinkConfig& link) = 0;
    /// Cuts off who is connected, and is no place to connect to any more.
    virtual void stop() = 0;
    /// Cuts off who is connected, so that the scanner may go: serve() or stop() follows in the same
    /// turn.
    void end_connection(Leaving why = Leaving::ended);

    /// What a client connects to: HOST:PORT with the port that was really taken, or the path of the
    /// tty's link.
    [[nodiscard]] virtual std::string address() const = 0;
    [[nodiscard]] virtual bool connected() const = 0;
    /// HOST:PORT of the TCP client that is connected; empty: there is none.
    [[nodiscard]] std::string client() const { return connected() ? client_ : std::string(); }
    /// HOST:PORT of the TCP clients that wait until that one disconnects, the next one first.
    [[nodiscard]] virtual std::vector<std::string> waiting() { return {}; }
    [[nodiscard]] virtual protocol::LinkKind kind() const = 0;

    // For faults. All may be called from within a call of the client that is connected.

    /// What the line does from now on, for who is connected and for who comes later.
    void set_line(const LineState& line);
    /// Null: none.
    void set_hook(LineHook* hook);
    /// Null: nobody listens. It must outlive that.
    void set_ear(WireEar* ear);
    [[nodiscard]] WireEar* ear() const { return ear_; }
    /// Null: nobody is told who comes and goes. It must outlive that.
    void set_watch(ClientWatch* watch) { watch_ = watch; }
    /// Ends the connection in the next turn; nothing goes either way any more. A tty hangs up and
    /// comes back under its name. The next client is welcome at once, unless the line refuses it.
    virtual void cut(Cut how) = 0;
    /// Sends bytes to who is connected, outside of all messages and behind what was sent already.
    void send_raw(std::string bytes);

    /// Since the port was made.
    [[nodiscard]] LinkCounts counts() const;
    [[nodiscard]] std::uint64_t lost_scans() const { return counts().lost_scans; }

  protected:
    void begin(std::shared_ptr<Connection> connection);
    /// From what the other has counted, too.
    void count_on_from(const Port& other) { counts_before_ += other.counts(); }
    /// Null: there is none.
    [[nodiscard]] Connection* connection() const { return connection_.get(); }

    [[nodiscard]] Limits& limits() const { return *limits_; }
    [[nodiscard]] const LineState& line() const { return line_; }
    /// The line may refuse clients now, or may no longer.
    virtual void follow_line() = 0;
    /// `from` as for ClientWatch.
    void tell_connected(const std::string& from) {
        client_ = from;
        if (watch_) watch_->came(from);
        if (hook_) hook_->connected(*this);
    }
    void tell_waits(const std::string& from) {
        if (watch_) watch_->waits(from, client_);
    }
    void tell_left(Leaving why) {
        if (watch_) watch_->left(kind(), why);
    }

  private:
    SharedLimits limits_ = std::make_shared<Limits>();
    LineState line_;
    LineHook* hook_ = nullptr;
    WireEar* ear_ = nullptr;
    ClientWatch* watch_ = nullptr;
    std::string client_;  ///< the latest one
    std::shared_ptr<Connection> connection_;
    LinkCounts counts_before_;  ///< by connections that have ended
};

}  // namespace scipd::daemon
