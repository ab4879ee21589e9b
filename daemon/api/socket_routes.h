// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Which WebSockets there are.
#pragma once

#include "daemon/api/routes.h"
#include "daemon/http/web_socket.h"

namespace scipd::daemon {

/// What a request for a WebSocket gets.
std::variant<HttpResponse, Converse> open_socket(Api& api, const HttpRequest& request);

/// To those who ask without an upgrade.
void ask_for_upgrade(Call&& call);

}  // namespace scipd::daemon
