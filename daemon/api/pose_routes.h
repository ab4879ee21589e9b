// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What all requests for poses share, of robots and of models.
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "daemon/api/documents.h"
#include "daemon/api/handlers.h"
#include "sim/loaders/poses/trajectory.h"

namespace scipd::daemon {

// `kind` is "robot" or "model".

/// In the words of a pose line, so that an answer can be sent as one.
Json pose_line_document(const char* kind, const std::string& name, const sim::TimedPose& timed);
/// The body of a PUT, which names nothing else than its path does; or why it is refused.
std::variant<sim::PoseLine, HttpResponse> pose_in(const Call& call, const char* kind);
/// 400, with the field that a refused line's sentence begins with.
HttpResponse pose_refused(const std::string& refusal);
/// 204, or 409 where the world has refused it.
HttpResponse accepted(const std::optional<std::string>& refusal);

}  // namespace scipd::daemon
