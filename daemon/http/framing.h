// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Whether it is plain where a request ends. Where it is not, a proxy before scipd may take for a
// body what scipd takes for the next request. And what its target is, however it is written.
// Stateless; any thread.
#pragma once

#include <optional>

#include <boost/beast/http/message.hpp>

#include "daemon/http/http_message.h"

namespace scipd::daemon {

/// What to answer, before the connection is closed, to a request whose end is not plain.
std::optional<HttpResponse> framing_fault(const boost::beast::http::request_header<>& request);

/// Makes of `http://HOST/PATH`, as proxies are sent it and every server must take it (RFC 9112,
/// 3.2.2), the target /PATH, and of Host that HOST, which is right where they differ. Leaves what
/// has no Host, or two.
void to_origin_form(boost::beast::http::request_header<>& request);

}  // namespace scipd::daemon
