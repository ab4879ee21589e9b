// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What an HTTP server and its connections share: who answers requests, what a client may send, and
// who is connected. Lives on the I/O thread.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "daemon/http/http_gate.h"
#include "daemon/http/http_message.h"
#include "daemon/http/web_socket.h"
#include "daemon/limits/limits.h"

namespace scipd::daemon {

/// Answers a request, at once or later.
using HttpHandler = std::function<void(const HttpRequest&, Respond)>;

/// What a server can do with a connection, whatever it runs over.
class HttpClient {
  public:
    virtual ~HttpClient() = default;
    virtual void close() = 0;
};

/// A place where clients connect. Each client has a hold of it until its connection ends, so that
/// the holds tell how many there are.
struct HttpDoor {
    std::string name;               ///< for the log
    Limit most;                     ///< of clients
    std::optional<Gate> gate = {};  ///< without one everybody may come in who can connect
};
using SharedDoor = std::shared_ptr<const HttpDoor>;

/// The server and its connections hold it together, since connections may end later.
struct HttpService {
    HttpHandler handler;
    OpenWebSocket open_web_socket;
    SharedLimits limits;
    /// A connection ends where no whole header has come for so long, or too little of a body or of
    /// an answer has passed (http_connection.h).
    std::chrono::milliseconds idle{60'000};
    bool closed = false;
    std::set<HttpClient*> clients;  ///< each adds and removes itself
};

}  // namespace scipd::daemon
