// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// An HTTP exchange as routes see it: no sockets, no library's types. Values; no thread rule.
#pragma once

#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "daemon/limits/rate.h"

namespace scipd::daemon {

struct HttpRequest {
    std::string method;  ///< "GET"
    std::string path;    ///< as the client sent it, without the query: "/robots/rescue/pose"
    std::string query;   ///< what followed the question mark, as the client sent it
    std::string body;
    std::string if_none_match = {};  ///< the ETags of what the client has already
    /// Stop is requested, on the I/O thread, when nobody is there any more who could get an answer.
    std::stop_token withdrawn = {};
    /// How much comes by this connection, for a handler that bounds it.
    std::shared_ptr<Rate> rate = std::make_shared<Rate>();
};

struct HttpResponse {
    int status = 200;
    std::string content_type = "application/json";
    std::string body;
    std::string allow = {};  ///< of a 405: the methods that the path has
    std::vector<std::pair<std::string, std::string>> headers = {};  ///< others, by name
};

/// To be called once, at any time, on the I/O thread. It takes the response by value, since bodies
/// can be large.
using Respond = std::function<void(HttpResponse)>;

}  // namespace scipd::daemon
