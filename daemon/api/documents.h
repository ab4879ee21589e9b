// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// JSON that all routes share.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "daemon/http/http_message.h"
#include "sim/time.h"
#include "sim/world/pose.h"

namespace scipd::daemon {

using Json = nlohmann::ordered_json;

double seconds(sim::Time time);
/// As many digits as a float has at a sensor's ranges.
double rounded(double value);
/// {"xyz":[..],"q":[x,y,z,w]}
Json pose_document(const sim::Pose& pose);
/// Compact; whatever bytes names have, the text is JSON.
std::string text_of(const Json& document);

/// With a line end, for those who read it in a terminal.
HttpResponse ok(const Json& document, int status = 200);
/// Answers with a document that is text already.
HttpResponse ok_text(std::string document, int status = 200);
/// 204
HttpResponse no_content();

}  // namespace scipd::daemon
