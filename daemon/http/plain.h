// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Between the messages of Beast and those that handlers see. Stateless; any thread.
#pragma once

#include <memory>

#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>

#include "daemon/http/http_message.h"
#include "daemon/limits/rate.h"

namespace scipd::daemon {

/// `rate` is that of the client. Nobody can withdraw the request yet.
HttpRequest to_plain(const boost::beast::http::request<boost::beast::http::string_body>& request,
                     const std::shared_ptr<Rate>& rate);

boost::beast::http::response<boost::beast::http::string_body> to_beast(HttpResponse plain,
                                                                       bool keep_alive);

}  // namespace scipd::daemon
