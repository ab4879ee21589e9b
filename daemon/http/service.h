// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What an HTTP server and its connections share: who answers requests, what a client may send, and
// who is connected. Lives on the I/O thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <set>

#include "daemon/http/message.h"
#include "daemon/http/web_socket.h"

namespace scipd::daemon {

/// Answers a request, at once or later.
using HttpHandler = std::function<void(const HttpRequest&, Respond)>;

struct HttpLimits {
    std::uint32_t header_bytes = 16 * 1024;
    std::uint64_t body_bytes = 1024 * 1024;
    /// A connection ends where no whole request has come for so long.
    std::chrono::milliseconds idle{60'000};
};

/// What a server can do with a connection, whatever it runs over.
class HttpClient {
  public:
    virtual ~HttpClient() = default;
    virtual void close() = 0;
};

/// The server and its connections hold it together, since connections may end later.
struct HttpService {
    HttpHandler handler;
    OpenWebSocket open_web_socket;
    HttpLimits limits;
    bool closed = false;
    std::set<HttpClient*> clients;  ///< each adds and removes itself
};

}  // namespace scipd::daemon
