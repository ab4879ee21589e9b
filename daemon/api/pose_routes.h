// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What all requests for poses share, of robots and of models.
#pragma once

#include <functional>
#include <string>

#include "daemon/api/api.h"
#include "daemon/api/documents.h"
#include "daemon/api/route_handlers.h"
#include "daemon/http/web_socket.h"
#include "sim/expected.h"
#include "sim/loaders/poses/pose_line.h"
#include "sim/loaders/poses/trajectory.h"

namespace scipd::daemon {

// `kind` is "robot" or "model".

/// In the words of a pose line, so that an answer can be sent as one.
Json pose_line_document(const char* kind, const std::string& name, const sim::TimedPose& timed);
/// The body of a PUT, which names nothing else than its path does.
sim::Expected<sim::PoseLine> pose_in(const Call& call, const char* kind);
/// 400
HttpResponse bad_request(const sim::Fault& fault);
/// 204, 429 where the client sends too many, or 409 where the world has refused it.
HttpResponse placed(const Call& call, const std::function<sim::Expected<>()>& place);

/// `api` must outlive the conversation.
std::unique_ptr<Conversation> take_poses(Api& api, WebSocket& socket);

}  // namespace scipd::daemon
