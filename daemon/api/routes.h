// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The control API without its sockets: a request in, a response out, over an abstract Api that the
// daemon implements. Which methods and paths there are is one table. On the I/O thread.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/api/api.h"
#include "daemon/http/message.h"

namespace scipd::daemon {

/// A request on its way to its answer.
struct Call {
    Api& api;
    const HttpRequest& request;      ///< until the answer's function returns
    std::vector<std::string> names;  ///< what the braces of the path stand for, in order
    Respond respond;
};

struct Route {
    std::string_view method;
    std::string_view path;  ///< "/robots/{robot}/pose"
    void (*answer)(Call&& call);
};

std::span<const Route> routes();

/// Responds once, now or later. Never throws on any request; what fails becomes a problem document.
void route(Api& api, const HttpRequest& request, Respond respond);

}  // namespace scipd::daemon
