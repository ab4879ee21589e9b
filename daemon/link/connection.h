// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Moves bytes between a file descriptor (a connected socket or the master side of a tty) and one
// session of a scanner, over the link that lies between. Reads, writes and waits; decides nothing.
// Lives on its shard.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <boost/asio/posix/stream_descriptor.hpp>

#include "daemon/clock/clock.h"
#include "daemon/config/link_config.h"
#include "daemon/limits/limits.h"
#include "daemon/link/client_watch.h"
#include "daemon/link/endpoint.h"
#include "daemon/link/line_hook.h"
#include "daemon/link/link_counts.h"
#include "daemon/link/link_model.h"
#include "daemon/link/outbox.h"

namespace scipd::daemon {

class Connection : public std::enable_shared_from_this<Connection> {
  public:
    using Descriptor = boost::asio::posix::stream_descriptor;

    struct Hooks {
        /// Whether anybody is at the other end. The connection asks before it reads or queues
        /// anything. Where nobody is, it drops what is to be sent.
        std::function<bool()> somebody_there = [] { return true; };
        /// The rate that the client's side of a serial line is set to. The connection asks whenever
        /// something goes either way, if the link has a rate at all.
        std::function<int()> client_rate = [] { return 0; };
        /// A tty stays when the device boots.
        protocol::LinkKind kind = protocol::LinkKind::network;
        /// Called once, when nothing more will come or go; never after close().
        std::function<void(Leaving why)> ended = [](Leaving) {};
    };

    /// `scanner` must live until close() or ended.
    Connection(Descriptor descriptor, Endpoint& scanner, const LinkConfig& link, Hooks hooks);

    /// To be called before start(). `here` is what the log calls the place.
    void hold_to(const SharedLimits& limits, const std::string& here);
    void start();
    void close();
    /// The client is gone, and whoever comes next is a new one. The new one gets nothing of what
    /// the old one asked, not even a half request, and nothing of what was to be sent to the old
    /// one, not even the rest of a half-sent message. What the old one began goes on.
    void forget();
    /// As forget(), and what the old one began ends, as by close().
    void hang_up();
    /// What the line does from here on; but for its rate.
    void set_line(const LineState& line);
    /// Null: none.
    void set_hook(LineHook* hook) { hook_ = hook; }
    /// Null: nobody listens.
    void set_ear(WireEar* ear) { ear_ = ear; }
    /// Sends bytes outside of all messages, behind what has been sent by the next turn.
    void send_raw(std::string bytes);
    /// Nothing goes either way from here on. It is to be closed in the next turn.
    void abandon() { abandoned_ = dead_ = stalled_ = true; }
    [[nodiscard]] int descriptor() { return descriptor_.native_handle(); }

    /// To be called from within somebody_there(). Drops what has been read and is not yet on its
    /// way to the device.
    void drop_input();
    /// Asked there: whether something has been read that is not yet on its way.
    [[nodiscard]] bool has_input() const { return received_ > 0; }

    [[nodiscard]] const LinkCounts& counts() const { return counts_; }
    [[nodiscard]] std::uint64_t lost() const { return counts_.lost_scans; }

  private:
    void read();
    void take_input(std::size_t count);
    void flush();
    void flush_soon();
    void deliver();
    void receive(std::string_view bytes);
    void perform(protocol::Action action, bool carried);
    void send(protocol::Send message);
    void write();
    void wait();
    void end_of_input();
    void drop();
    void drop_under_way();
    [[nodiscard]] std::optional<protocol::Action> next_action();
    void end_if_done();
    void end_soon();
    void end();

    Descriptor descriptor_;
    Hooks hooks_;
    std::unique_ptr<Endpoint::Client> client_;  ///< null once closed or ended
    Clock& clock_;
    std::unique_ptr<Clock::Alarm> alarm_;
    LinkModel inbox_;  ///< requests on their way to the device
    Outbox outbox_;
    LineHook* hook_ = nullptr;
    WireEar* ear_ = nullptr;
    bool stalled_ = false;
    bool dead_ = false;
    bool abandoned_ = false;
    int device_rate_;      ///< of the device's side of a serial line; 0: there is none
    std::string sending_;  ///< what is being written
    std::array<char, 4096> input_;
    std::size_t received_ = 0;    ///< bytes of input_ that are not yet on their way to the device
    bool drops_reading_ = false;  ///< the read under way is to be dropped when it is reported
    bool reading_ = false;
    bool writing_ = false;
    bool input_ended_ = false;
    Leaving why_ended_ = Leaving::closed;
    LinkCounts counts_;
};

}  // namespace scipd::daemon
