// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A WebSocket as a route sees it: whole text messages, without frames and without the library that
// makes them. Lives on the I/O thread.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <variant>

#include "daemon/http/http_message.h"

namespace scipd::daemon {

/// The connection, for whoever talks over it.
class WebSocket {
  public:
    virtual ~WebSocket() = default;
    /// Sends a message after those that are queued already. One text can be sent to many clients.
    virtual void send(std::shared_ptr<const std::string> message) = 0;
    /// Sends a message that is no text, after those that are queued already.
    virtual void send_bytes(std::shared_ptr<const std::string> message) = 0;
    /// Ends the connection, in another turn of the event loop. For a client that does not read.
    virtual void cut() = 0;
};

/// What the daemon says and hears over one connection. It is destroyed before the connection ends.
class Conversation {
  public:
    virtual ~Conversation() = default;
    /// Takes some of what is left of a message, within a short time, and answers how many bytes it
    /// has taken: at least 1, where there are any. It gets the others in another turn of the event
    /// loop. It gets nothing while much is queued that the client does not read.
    virtual std::size_t take(std::string_view rest) = 0;
    /// The oldest message in the queue has left.
    virtual void left() {}
};

/// Begins a conversation over a socket that outlives it.
using Converse = std::function<std::unique_ptr<Conversation>(WebSocket&)>;

/// Answers a request for a WebSocket: with a conversation, or with a refusal.
using OpenWebSocket = std::function<std::variant<HttpResponse, Converse>(const HttpRequest&)>;

}  // namespace scipd::daemon
