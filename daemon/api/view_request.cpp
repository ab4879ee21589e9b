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

sim::Expected<ViewRequest::Scans> scans_in(const nlohmann::json& wanted) {
    if (!wanted.is_object()) return refuse("scans", "scans must be an object: {\"R/S\": {}}");
    ViewRequest::Scans scans;
    for (const auto& [sensor, how] : wanted.items()) {
        if (!how.is_object()) {
            return refuse("scans", "scans." + sim::printable(sensor, 64) +
                                       " must be an object: {} or {\"true\": true}");
        }
        const auto truth = how.find("true");
        if (truth != how.end() && !truth->is_boolean())
            return refuse("scans",
                          "scans." + sim::printable(sensor, 64) + ".true must be true or false");
        const bool deep = truth != how.end() && truth->get<bool>();
        scans.emplace(sensor, deep ? ViewDepth::truth : ViewDepth::sent);
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
        } else if (key == "ack_poses" && value == true) {
            request.ack_poses = true;
        } else {
            return refuse(sim::printable(key, 64), "the key " + sim::quote(key) +
                                                       " is unknown; there are scans, ack and "
                                                       "ack_poses, which is true");
        }
    }
    return request;
}

}  // namespace scipd::daemon
