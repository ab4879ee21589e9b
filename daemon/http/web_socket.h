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

#include "daemon/http/message.h"

namespace scipd::daemon {

/// The connection, for whoever talks over it.
class WebSocket {
  public:
    virtual ~WebSocket() = default;
    /// After what is queued already. One text can be sent to many.
    virtual void send(std::shared_ptr<const std::string> message) = 0;
};

/// One talk over one connection; ends, with its destruction, before the connection does.
class Conversation {
  public:
    virtual ~Conversation() = default;
    /// What is left of a message: answers with how many bytes of it, 1 or more where there are any,
    /// it has taken within a short time, and is called with the others in another turn of the event
    /// loop. Not called while much is queued that the client does not read.
    virtual std::size_t take(std::string_view rest) = 0;
    /// The oldest message that was sent has left.
    virtual void left() {}
};

/// Begins one over a socket that outlives it.
using Converse = std::function<std::unique_ptr<Conversation>(WebSocket&)>;

/// What a request for a WebSocket is answered with: a talk, or why there is none.
using OpenWebSocket = std::function<std::variant<HttpResponse, Converse>(const HttpRequest&)>;

}  // namespace scipd::daemon
