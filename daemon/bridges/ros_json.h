// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What rosbridge says, in JSON ("rosbridge v2.0 Protocol Specification"): messages of ROS 1 and 2
// that tell where something is. A message does not name its type, but shows it. Values; any thread.
#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "daemon/bridges/heard.h"
#include "sim/expected.h"

namespace scipd::daemon {

struct RosbridgePublish {
    std::string topic;
    Heard heard;
};

/// rosbridge cannot do what was asked of it.
struct RosbridgeRefusal {
    std::string id;  ///< of the request
    std::string why;
};

/// What matters to nobody here.
struct RosbridgeOther {};

using RosbridgeMessage = std::variant<RosbridgePublish, RosbridgeRefusal, RosbridgeOther>;

/// Refused where it is no JSON, or a message that tells of no place.
sim::Expected<RosbridgeMessage> read_rosbridge(std::string_view text);

/// Asks for all messages of a topic; the topic is the id of the request.
std::string subscription_to(const std::string& topic);

}  // namespace scipd::daemon
