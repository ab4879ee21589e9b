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

constexpr std::array<std::string_view, 6> replay_keys{"file",  "stream", "loop",
                                                      "speed", "from_s", "begins_s"};

using Begins = std::variant<std::chrono::nanoseconds, AsRecorded>;

sim::Expected<std::optional<Begins>> parse_begins(std::string_view text) {
    if (text == "recorded") return Begins(AsRecorded{});
    const auto stamp = sim::parse_stamp(text);
    if (stamp) return Begins(*stamp);
    return sim::refuse("must be a stamp in seconds, within 9e9, or recorded, not " +
                       sim::quote(text));
}

}  // namespace

sim::Expected<std::filesystem::path> parse_recording(std::string_view text,
                                                     const std::filesystem::path& base) {
    if (sim::extension_of(text) == ".tum")
        return sim::refuse(sim::quote(text) +
                           " is a trajectory, not a recording; a robot follows it by its poses "
                           "(--poses)");
    return parse_file(text, base);
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
    const auto parse = [&](const std::string& text) { return parse_recording(text, base); };
    if (!field.value.IsMap()) {
        faults.take(field, sim::text_of(field.value).and_then(parse), replay.file);
        return replay;
    }
    const sim::YamlSection section{field, replay_keys, faults};
    if (!section.find("file")) faults.add(field, "needs a file, which is a recording");
    section.read("file", replay.file, parse);
    section.read("stream", replay.stream);
    section.read("loop", replay.loop, parse_loop);
    section.read("speed", replay.speed, parse_speed);
    section.read("from_s", replay.from, parse_span);
    section.read("begins_s", replay.begins, parse_begins);
    if (const sim::YamlField* begins = section.find("begins_s"); begins && section.find("from_s"))
        faults.add(*begins, "give begins_s or from_s, not both");
    return replay;
}

}  // namespace scipd::daemon
