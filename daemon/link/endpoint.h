// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The scanner's end of a link, as the link sees it: it gives each client a session, and says what
// time it is. daemon/device implements it, so that a link needs to know no world. Lives on the I/O
// thread.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string_view>

#include "daemon/clock/clock.h"
#include "protocol/session.h"
#include "sim/random.h"
#include "sim/time.h"

namespace scipd::daemon {

class Endpoint {
  public:
    /// One client at this end. It is gone when this is destroyed.
    class Client {
      public:
        Client(const Client&) = delete;
        Client& operator=(const Client&) = delete;
        virtual ~Client() = default;

        /// Says what to send, and is told when the client leaves. Bytes and the time reach it by
        /// receive() and wake() alone: the device looks at what they have changed.
        [[nodiscard]] protocol::Session& session() { return session_; }
        [[nodiscard]] const protocol::Session& session() const { return session_; }

        virtual void receive(std::string_view bytes) = 0;
        /// When wake() is due; nothing: not before something else happens.
        [[nodiscard]] virtual std::optional<sim::Time> wake_at() const = 0;
        virtual void wake() = 0;

      protected:
        Client(const protocol::DeviceProfile& profile, protocol::DeviceState& state,
               protocol::LinkKind link)
            : session_(profile, state, link) {}

      private:
        protocol::Session session_;
    };

    Endpoint() = default;
    Endpoint(const Endpoint&) = delete;
    Endpoint& operator=(const Endpoint&) = delete;
    virtual ~Endpoint() = default;

    /// The endpoint must outlive the client. `on_actions` is called whenever the session may have
    /// something to send, but not from within a call of this client's.
    [[nodiscard]] virtual std::unique_ptr<Client> connect(std::function<void()> on_actions,
                                                          protocol::LinkKind link) = 0;
    /// The clock that clients wait by: that of the world.
    [[nodiscard]] virtual Clock& clock() = 0;
    /// What is random about the links to this scanner, the same in every run.
    [[nodiscard]] virtual sim::ChanceKey chance(sim::Purpose purpose) const = 0;
};

}  // namespace scipd::daemon
