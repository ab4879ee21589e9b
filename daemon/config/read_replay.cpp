// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/config/read_replay.h"

#include <array>
#include <string>
#include <string_view>

#include "daemon/config/numbers.h"
#include "daemon/config/values.h"
#include "sim/loaders/mesh/mesh_file.h"
#include "sim/text/quote.h"
#include "sim/text/text_number.h"

namespace scipd::daemon {
namespace {

constexpr std::array<std::string_view, 7> replay_keys{"file",   "stream", "loop",    "speed",
                                                      "from_s", "begins", "begins_s"};

using Stamp = std::variant<std::chrono::nanoseconds, AsRecorded>;

sim::Expected<ReplayStart> parse_begins(std::string_view text) {
    if (text == "client") return ReplayStart::client;
    if (text == "start") return ReplayStart::start;
    return sim::refuse(
        "must be client (with the first program that takes scans) or start (with scipd), not " +
        sim::quote(text));
}

sim::Expected<std::optional<Stamp>> parse_begins_s(std::string_view text) {
    if (text == "recorded") return Stamp(AsRecorded{});
    const auto stamp = sim::parse_stamp(text);
    if (stamp) return Stamp(*stamp);
    return sim::refuse("must be a stamp in seconds, within 9e9, or recorded, not " +
                       sim::quote(text));
}

/// A path, or a list of those that are one recording.
void read_files(const sim::YamlField& field, const std::filesystem::path& base,
                sim::YamlFaults& faults, std::vector<std::filesystem::path>& files) {
    const auto read = [&](const YAML::Node& node) {
        const auto file = sim::text_of(node).and_then(
            [&](const std::string& text) { return parse_recording(text, base); });
        if (file) files.push_back(*file);
        if (!file) faults.add(field, file.error().why);
    };
    if (!field.value.IsSequence()) return read(field.value);
    if (field.value.size() == 0) faults.add(field, "needs a file, which is a recording");
    for (const YAML::Node& node : field.value)
        read(node);
}

}  // namespace

sim::Expected<std::filesystem::path> parse_recording(std::string_view text,
                                                     const std::filesystem::path& base) {
    if (sim::extension_of(text) == ".tum")
        return sim::refuse(sim::quote(text) +
                           " is a trajectory, not a recording; a robot follows it by its poses "
                           "(--poses)");
    return parse_scene(text, base);  // or a folder, as a bag of rosbag2 is
}

sim::Expected<ReplayLoop> parse_loop(std::string_view text) {
    if (text == "on") return ReplayLoop::on;
    if (text == "true" || text == "yes") return ReplayLoop::again;
    if (text == "false" || text == "no") return ReplayLoop::none;
    return sim::refuse(
        "must be true (each round has the recorded stamps), on (stamps go on) or "
        "false, not " +
        sim::quote(text));
}

ReplayConfig read_replay(const sim::YamlField& field, const std::filesystem::path& base,
                         sim::YamlFaults& faults) {
    ReplayConfig replay;
    if (!field.value.IsMap()) {
        read_files(field, base, faults, replay.files);
        return replay;
    }
    const sim::YamlSection section{field, replay_keys, faults};
    const sim::YamlField* const file = section.find("file");
    if (file == nullptr) faults.add(field, "needs a file, which is a recording");
    if (file != nullptr) read_files(*file, base, faults, replay.files);
    section.read("stream", replay.stream);
    section.read("loop", replay.loop, parse_loop);
    section.read("speed", replay.speed, parse_speed);
    section.read("from_s", replay.from, parse_span);
    section.read("begins", replay.begins, parse_begins);
    section.read("begins_s", replay.begins_s, parse_begins_s);
    for (const char* const key : {"from_s", "begins"}) {
        const sim::YamlField* const stamp = section.find("begins_s");
        if (stamp != nullptr && section.find(key))
            faults.add(*stamp, "give begins_s or " + std::string(key) + ", not both");
    }
    return replay;
}

}  // namespace scipd::daemon
