// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/fleet/notes.h"

#include <nlohmann/json.hpp>

#include "sim/loaders/poses/small_json.h"

namespace scipd::daemon {
namespace {

using Json = nlohmann::ordered_json;

// A daemon has 4096 sensors at most, and each robot one of them.
constexpr int most_values = 20'000;

std::string written(const Json& document) {
    return document.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
}

/// The text under this key; empty where there is none.
std::string text_in(const nlohmann::json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

sim::Expected<nlohmann::json> object_in(std::string_view text) {
    auto object = sim::parse_small_json(text, most_values);
    if (object && !object->is_object()) return sim::refuse("must be a JSON object");
    return object;
}

std::map<std::string, std::string> bodies_in(const nlohmann::json& object) {
    std::map<std::string, std::string> bodies;
    const auto robots = object.find("robots");
    if (robots == object.end() || !robots->is_object()) return bodies;
    for (const auto& [robot, said] : robots->items())
        bodies[robot] = said.is_object() ? text_in(said, "body") : "";
    return bodies;
}

}  // namespace

std::string text_of(const SceneNote& note) {
    return written({{"hash", note.hash}, {"by", note.by}, {"begun_s", note.begun_s}});
}

std::string text_of(const DaemonNote& note) {
    Json robots = Json::object();
    for (const auto& [robot, body] : note.bodies) {
        robots[robot] = Json::object();
        if (!body.empty()) robots[robot]["body"] = body;
    }
    Json document{{"name", note.name},         {"state", note.lost ? "lost" : "serving"},
                  {"instance", note.instance}, {"clock", note.in_steps ? "poses" : "wall"},
                  {"host", note.host},         {"sensors", note.sensors},
                  {"robots", robots}};
    if (!note.trouble.empty()) document["trouble"] = note.trouble;
    return written(document);
}

std::string other_world(const SceneNote& theirs, const SceneNote& ours, const std::string& world) {
    return "the world " + world + " of the broker is another one: its content is " + theirs.hash +
           " (says daemon " + theirs.by + "), here it is " + ours.hash +
           "; start all daemons with the same scene, or this one with another fleet.world";
}

sim::Expected<SceneNote> parse_scene_note(std::string_view text) {
    return object_in(text).and_then([](const nlohmann::json& object) -> sim::Expected<SceneNote> {
        SceneNote note{.hash = text_in(object, "hash"), .by = text_in(object, "by")};
        if (note.hash.empty()) return sim::refuse("hash", "hash must be a text");
        const auto begun = object.find("begun_s");
        if (begun != object.end() && begun->is_number()) note.begun_s = *begun;
        return note;
    });
}

sim::Expected<DaemonNote> parse_daemon_note(std::string_view text) {
    return object_in(text).and_then([](const nlohmann::json& object) -> sim::Expected<DaemonNote> {
        DaemonNote note{.name = text_in(object, "name"),
                        .instance = text_in(object, "instance"),
                        .lost = text_in(object, "state") == "lost",
                        .in_steps = text_in(object, "clock") == "poses",
                        .host = text_in(object, "host"),
                        .bodies = bodies_in(object),
                        .trouble = text_in(object, "trouble")};
        if (note.name.empty()) return sim::refuse("name", "name must be a text");
        const auto sensors = object.find("sensors");
        if (sensors != object.end() && sensors->is_number_integer()) note.sensors = *sensors;
        return note;
    });
}

}  // namespace scipd::daemon
