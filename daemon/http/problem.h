// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The problem document (RFC 9457) that the control API answers with when it refuses a request.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "daemon/http/http_message.h"

namespace scipd::daemon {

/// The reason phrase of a status; "Error" for a status that is not listed here.
std::string_view http_title(int status);

/// {"type":"about:blank","title","status","detail"} and, unless it is empty, "field": the part of
/// the request that is at fault. "errors" has what is wrong in that part, where it is much.
HttpResponse problem(int status, std::string_view detail, std::string_view field = {},
                     const std::vector<std::string>& errors = {});

}  // namespace scipd::daemon
