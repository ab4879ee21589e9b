// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The control API without its sockets: a request goes in, a response comes out. The daemon
// implements the abstract Api behind it. One table has all methods and paths. On the I/O thread.
#pragma once

#include <span>
#include <string_view>
#include <variant>

#include "daemon/api/route_handlers.h"
#include "daemon/http/web_socket.h"

namespace scipd::daemon {

struct Route {
    std::string_view method;
    std::string_view path;  ///< "/robots/{robot}/pose"
    void (*answer)(Call&& call);
};

std::span<const Route> routes();

/// Responds once, now or later. Never throws on any request; what fails becomes a problem document.
void route(Api& api, const HttpRequest& request, Respond respond);

/// Answers a request for a WebSocket.
std::variant<HttpResponse, Converse> open_socket(Api& api, const HttpRequest& request);

}  // namespace scipd::daemon
