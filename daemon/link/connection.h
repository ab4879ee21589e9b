// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Bytes in and out between a file descriptor (a connected socket or the master side of a tty) and
// one client of a device, over the link that lies between. Reads, writes and waits; decides
// nothing. Lives on the I/O thread.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include <boost/asio/posix/stream_descriptor.hpp>

#include "daemon/clock/clock.h"
#include "daemon/device/client.h"
#include "daemon/link/link_model.h"
#include "daemon/link/outbox.h"

namespace scipd::daemon {

class Connection : public std::enable_shared_from_this<Connection> {
  public:
    using Descriptor = boost::asio::posix::stream_descriptor;

    struct Hooks {
        /// Whether anybody is at the other end: asked before anything is read or queued. Without
        /// anybody, what is to be sent is dropped.
        std::function<bool()> somebody_there = [] { return true; };
        /// The rate that the client's side of a serial line is set to. Asked whenever something
        /// goes either way, if the link has a rate at all.
        std::function<int()> client_rate = [] { return 0; };
        /// A tty stays where the device boots.
        protocol::LinkKind kind = protocol::LinkKind::network;
        /// Called once, when nothing more will come or go. Not after close().
        std::function<void()> ended = [] {};
    };

    /// `device` must live until close() or ended.
    Connection(Descriptor descriptor, Device& device, const LinkConfig& link, Hooks hooks);

    void start();
    void close();
    /// The client is gone, and whoever comes next is a new one, who gets nothing of what the first
    /// one asked, of a half request or of what was to be sent, also half sent. What it began goes
    /// on, ..
    void forget();
    /// .. or ends, as by close().
    void hang_up();
    /// To be called from within somebody_there(): what has been read and is not on its way to the
    /// device is not for it.
    void drop_input();

    /// Scans that the client read too slowly for.
    [[nodiscard]] std::uint64_t lost() const { return lost_; }

  private:
    void read();
    void take_input(std::size_t count);
    void flush();
    void deliver();
    void perform(protocol::Action action, bool somebody_there);
    void write();
    void wait();
    void end_of_input();
    void drop();
    void drop_under_way();
    void end_if_done();
    void end();

    Descriptor descriptor_;
    Hooks hooks_;
    std::unique_ptr<Client> client_;  ///< null once closed or ended
    Clock& clock_;
    std::unique_ptr<Clock::Alarm> alarm_;
    LinkModel inbox_;  ///< requests on their way to the device
    Outbox outbox_;
    int device_rate_;      ///< of the device's side of a serial line; 0: there is none
    std::string sending_;  ///< what is being written
    std::array<char, 4096> input_;
    std::size_t received_ = 0;    ///< of it, and not yet on its way to the device
    bool drops_reading_ = false;  ///< what is being read, or has been and is still to be reported
    bool reading_ = false;
    bool writing_ = false;
    bool input_ended_ = false;
    std::uint64_t lost_ = 0;
};

}  // namespace scipd::daemon
