// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One client of a device, seen from its connection: bytes in, messages out, and when to wake it.
// Registers its session with the device for as long as it lives. Lives on the I/O thread.
#pragma once

#include <functional>
#include <optional>
#include <string_view>

#include "daemon/clock/clock.h"
#include "daemon/device/device.h"
#include "protocol/action.h"
#include "protocol/session.h"

namespace scipd::daemon {

class Client {
  public:
    /// `on_actions` is called whenever next_action() may have something, but not from within a
    /// call of this client's.
    Client(Device& device, std::function<void()> on_actions,
           protocol::LinkKind link = protocol::LinkKind::network);
    Client(const Client&) = delete;
    Client& operator=(const Client&) = delete;
    ~Client();

    void receive(std::string_view bytes);
    /// Nothing more may be handed to receive() until requests have been answered.
    [[nodiscard]] bool full() const { return session_.full(); }
    [[nodiscard]] bool streaming() const { return session_.streaming(); }
    /// Requests wait for their answers.
    [[nodiscard]] bool busy() const {
        return session_.measuring() || session_.wake_at().has_value();
    }

    /// When wake() is due; nothing: not before something else happens.
    [[nodiscard]] std::optional<sim::Time> wake_at() const;
    void wake();

    /// What the client began ends, what it asked is forgotten; another one may follow.
    void hang_up() { session_.close(); }
    /// What it asked is forgotten, what it began goes on; another one may follow.
    void forget() { session_.forget(); }

    [[nodiscard]] std::optional<protocol::Action> next_action() { return session_.next_action(); }

  private:
    friend class Device;

    Device& device_;
    protocol::Session session_;
    std::function<void()> on_actions_;
};

}  // namespace scipd::daemon
