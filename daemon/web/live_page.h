// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The live page as a browser gets it. Any thread.
#pragma once

#include <string_view>

#include "daemon/http/http_message.h"

namespace scipd::daemon {

/// Answers a request for a file of the page: with the file, with 304 if the browser has it already,
/// or with a refusal that says why there is none.
HttpResponse page_file(std::string_view name, const HttpRequest& request);

/// Whether the page lies at this path: everybody may have it who can connect, since it holds no
/// secret, and it is what asks for the token.
bool is_of_page(std::string_view path);

}  // namespace scipd::daemon
