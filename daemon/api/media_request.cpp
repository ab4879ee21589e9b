// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/api/media_request.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "daemon/config/media.h"
#include "sim/loaders/poses/small_json.h"
#include "sim/text/quote.h"
#include "sim/world/reach.h"

namespace scipd::daemon {
namespace {

using sim::Expected;
using MediumJson = nlohmann::json;

/// Keys, values and ends of lists that the longest list of media has, and some.
constexpr int most_json_values = 64 * static_cast<int>(most_media);

std::optional<glm::dvec3> corner_in(const MediumJson& box, const char* key) {
    const auto found = box.find(key);
    if (found == box.end() || !found->is_array() || found->size() != 3) return std::nullopt;
    glm::dvec3 corner_m{};
    for (int axis = 0; axis < 3; ++axis) {
        const MediumJson& number = (*found)[static_cast<std::size_t>(axis)];
        if (!number.is_number()) return std::nullopt;
        corner_m[axis] = number.get<double>();
    }
    if (!sim::plausible_position(corner_m)) return std::nullopt;
    return corner_m;
}

Expected<> read_word(const MediumJson& value, const std::string& key, std::string& text) {
    if (!value.is_string() || value.get_ref<const std::string&>().empty())
        return sim::refuse(key, "must be a text that is not empty");
    text = value;
    return {};
}

Expected<> read_corners(const MediumJson& value, MediumRequest& request) {
    if (!value.is_object() || value.size() != 2)
        return sim::refuse("box", R"(must be {"from":[X,Y,Z],"to":[X,Y,Z]})");
    const auto from_m = corner_in(value, "from");
    const auto to_m = corner_in(value, "to");
    if (!from_m || !to_m)
        return sim::refuse("box", "must have from and to, three numbers within 1e7 m each");
    request.box_m = {*from_m, *to_m};
    return {};
}

Expected<> read_key(const std::string& key, const MediumJson& value, MediumRequest& request) {
    if (key == "kind") return read_word(value, key, request.kind);
    if (key == "name") return read_word(value, key, request.name);
    if (key == "box") return read_corners(value, request);
    if (std::ranges::find(medium_numbers(), key) == medium_numbers().end())
        return sim::refuse(sim::printable(key, 64), "is no key of a medium");
    if (!value.is_number()) return sim::refuse(key, "must be a number");
    request.numbers[key] = value.get<double>();
    return {};
}

Expected<MediumRequest> request_in(const MediumJson& object) {
    if (!object.is_object()) return sim::refuse(R"(must be an object such as {"kind":"fog",..})");
    MediumRequest request;
    for (const auto& [key, value] : object.items()) {
        if (const auto read = read_key(key, value, request); !read)
            return tl::unexpected(read.error());
    }
    return request;
}

/// "[2].visibility_m", or "[2]" for the whole of it.
sim::Fault placed(std::size_t index, const sim::Fault& fault) {
    const std::string field =
        "[" + std::to_string(index) + "]" + (fault.field.empty() ? "" : ".") + fault.field;
    return {field, field + " " + fault.why};
}

Expected<> add(const MediumJson& object, std::vector<sim::Medium>& media) {
    const auto request = request_in(object);
    if (!request) return tl::unexpected(request.error());
    std::optional<sim::Fault> first;
    add_medium(*request, media, [&](std::string_view key, const std::string& why) {
        if (!first) first = {std::string(key), why};
    });
    if (first) return tl::unexpected(*std::move(first));
    return {};
}

Json box_document(const sim::Medium& medium) {
    const glm::dvec3& low = medium.low_m;
    const glm::dvec3& high = medium.high_m;
    return {{"from", {low.x, low.y, low.z}}, {"to", {high.x, high.y, high.z}}};
}

Json medium_document(const sim::Medium& medium) {
    Json document{{"kind", medium.kind}, {"name", medium.name}};
    if (const auto key = amount_key(medium.kind); !key.empty()) {
        document[std::string(key)] = medium.amount;
    } else {
        document["extinction_per_m"] = medium.extinction_per_m;
        document["returns_per_m"] = medium.returns_per_m;
        document["brightness"] = medium.brightness;
    }
    if (std::isfinite(medium.low_m.x)) document["box"] = box_document(medium);
    return document;
}

}  // namespace

Expected<std::vector<sim::Medium>> parse_media(const std::string& body) {
    const auto list = sim::parse_small_json(body, most_json_values);
    if (!list) return sim::refuse("the body must be a list of media: " + list.error().why);
    if (!list->is_array() || list->size() > most_media)
        return sim::refuse("the body must be a list of at most " + std::to_string(most_media) +
                           " media");
    std::vector<sim::Medium> media;
    for (std::size_t i = 0; i < list->size(); ++i) {
        if (const auto added = add((*list)[i], media); !added)
            return tl::unexpected(placed(i, added.error()));
    }
    return media;
}

Json media_document(const std::vector<sim::Medium>& media) {
    Json list = Json::array();
    for (const sim::Medium& medium : media)
        list.push_back(medium_document(medium));
    return list;
}

}  // namespace scipd::daemon
