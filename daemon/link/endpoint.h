// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The scanner's end of a link, as the link sees it: it speaks to each client, and says what time it
// is. daemon/device implements it, so that a link needs to know no world, and so does the proxy of
// scipcat before a real scanner. Lives on the I/O thread.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string_view>

#include "daemon/clock/clock.h"
#include "protocol/refusal.h"
#include "protocol/speaker.h"
#include "sim/random.h"
#include "sim/time.h"

namespace scipd::daemon {

class Endpoint {
  public:
    /// One client at this end. It is gone when this is destroyed.
    class Client {
      public:
        Client() = default;
        Client(const Client&) = delete;
        Client& operator=(const Client&) = delete;
        virtual ~Client() = default;

        /// Says what to send, and is told when the client leaves. Bytes and the time reach it by
        /// receive() and wake() alone: the device looks at what they have changed.
        [[nodiscard]] virtual protocol::Speaker& session() = 0;

        virtual void receive(std::string_view bytes) = 0;
        /// When wake() is due; nothing: not before something else happens.
        [[nodiscard]] virtual std::optional<sim::Time> wake_at() const = 0;
        virtual void wake() = 0;
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
