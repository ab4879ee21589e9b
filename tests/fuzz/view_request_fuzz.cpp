// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Any bytes as a message of a page over /view: a refusal says why, and what is accepted means the
// same when it is said again.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "daemon/api/view_request.h"

namespace {

using namespace scipd::daemon;

void require(bool holds) {
    if (!holds) std::abort();
}

/// As short as can be: what is said has a greatest length.
nlohmann::json said(const ViewRequest& request) {
    nlohmann::json message = nlohmann::json::object();
    if (request.scans) {
        message["scans"] = nlohmann::json::object();
        for (const auto& [sensor, depth] : *request.scans) {
            nlohmann::json& how = message["scans"][sensor] = nlohmann::json::object();
            if (depth == ViewDepth::truth) how["true"] = true;
        }
    }
    if (request.ack) message["ack"] = *request.ack;
    if (request.ack_poses) message["ack_poses"] = true;
    return message;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto request = parse_view_request({reinterpret_cast<const char*>(data), size});
    if (!request) {
        require(!request.error().why.empty());
        return 0;
    }
    const auto again = parse_view_request(said(*request).dump());
    require(again.has_value() && again->scans == request->scans && again->ack == request->ack &&
            again->ack_poses == request->ack_poses);
    return 0;
}
