// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/api/view_request.h"

#include <limits>
#include <utility>

#include "sim/loaders/poses/small_json.h"
#include "sim/text/name.h"
#include "sim/text/quote.h"

namespace scipd::daemon {
namespace {

using sim::refuse;

/// `where`: "scans.R/S".
sim::Expected<ViewDepth> depth_in(const nlohmann::json& how, const std::string& where) {
    if (!how.is_object())
        return refuse("scans", where + " must be an object: {} or {\"true\": true}");
    ViewDepth depth = ViewDepth::sent;
    for (const auto& [key, value] : how.items()) {
        if (key != "true") {
            return refuse(
                "scans", where + ": the key " + sim::quote(key) + " is unknown; there is \"true\"");
        }
        if (!value.is_boolean()) return refuse("scans", where + ".true must be true or false");
        if (value.get<bool>()) depth = ViewDepth::truth;
    }
    return depth;
}

sim::Expected<ViewRequest::Scans> scans_in(const nlohmann::json& wanted) {
    if (!wanted.is_object()) return refuse("scans", "scans must be an object: {\"R/S\": {}}");
    ViewRequest::Scans scans;
    for (const auto& [sensor, how] : wanted.items()) {
        const auto depth = depth_in(how, "scans." + sim::printable(sensor, 64));
        if (!depth) return tl::unexpected(depth.error());
        scans.emplace(sensor, *depth);
    }
    return scans;
}

sim::Expected<std::uint32_t> number_in(const nlohmann::json& value) {
    if (!value.is_number_unsigned() ||
        value.get<std::uint64_t>() > std::numeric_limits<std::uint32_t>::max())
        return refuse("ack", "ack must be the number of a frame");
    return value.get<std::uint32_t>();
}

}  // namespace

sim::Expected<ViewRequest> parse_view_request(std::string_view text) {
    const auto object = sim::parse_small_json(text);
    if (!object) return refuse("a message must be a JSON object: " + object.error().why);
    if (!object->is_object()) return refuse("a message must be a JSON object");
    ViewRequest request;
    for (const auto& [key, value] : object->items()) {
        if (key == "scans") {
            auto scans = scans_in(value);
            if (!scans) return tl::unexpected(scans.error());
            request.scans = *std::move(scans);
        } else if (key == "ack") {
            const auto number = number_in(value);
            if (!number) return tl::unexpected(number.error());
            request.ack = *number;
        } else if (key == "ack_poses") {
            if (value != true) return refuse(key, "ack_poses must be true");
            request.ack_poses = true;
        } else {
            return refuse(
                sim::printable(key, 64),
                "the key " + sim::quote(key) + " is unknown; there are scans, ack and ack_poses");
        }
    }
    return request;
}

}  // namespace scipd::daemon
