// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The WebSocket /poses: pose lines from a simulator, in any number a message. A message of which
// something is refused is answered with one problem document; the others are not answered. Lives on
// the I/O thread.
#pragma once

#include "daemon/api/api.h"
#include "daemon/http/web_socket.h"

namespace scipd::daemon {

/// `api` must outlive the conversation.
std::unique_ptr<Conversation> take_poses(Api& api, WebSocket& socket);

}  // namespace scipd::daemon
