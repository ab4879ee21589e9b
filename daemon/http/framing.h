// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Whether it is plain where a request ends. Where it is not, a proxy before scipd may take for a
// body what scipd takes for the next request. Stateless; any thread.
#pragma once

#include <optional>

#include <boost/beast/http/message.hpp>

#include "daemon/http/message.h"

namespace scipd::daemon {

/// What to answer, before the connection is closed, to a request whose end is not plain.
std::optional<HttpResponse> framing_fault(const boost::beast::http::request_header<>& request);

}  // namespace scipd::daemon
