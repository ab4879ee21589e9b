// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <algorithm>
#include <array>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/text/text_number.h"
#include "tools/control_client.h"
#include "tools/options.h"
#include "tools/scipctl/names.h"
#include "tools/scipctl/scipctl_commands.h"

namespace scipd::tools {
namespace {

using Json = ControlClient::Json;

/// What may be done, with the member of the request, and the value that nobody needs to give.
struct Verb {
    std::string_view word;
    const char* member;
    std::optional<Json> value;
};

const std::array<Verb, 5>& verbs() {
    static const std::array<Verb, 5> all{{{"seek", "at_s", std::nullopt},
                                          {"step", "step", 1},
                                          {"pause", "paused", true},
                                          {"play", "paused", false},
                                          {"speed", "speed", std::nullopt}}};
    return all;
}

struct ReplayAsked {
    std::vector<std::string> words;
    bool json = false;
};

[[noreturn]] void explain_usage(const std::string& wrong) {
    throw WrongInput(wrong + "; use seek SECONDS, step [SCANS], pause, play or speed FACTOR");
}

Json value_of(const Verb& verb, const std::vector<std::string>& words) {
    if (words.size() > 2) explain_usage("'" + words[2] + "' is too much");
    if (words.size() < 2) {
        if (!verb.value) explain_usage(std::string(verb.word) + " needs a number");
        return *verb.value;
    }
    const auto number = sim::parse_number(words[1]);
    if (!number || (verb.value && !verb.value->is_number()))
        explain_usage("'" + words[1] + "' is no number of " + std::string(verb.word));
    return *number;
}

Json steering(const std::vector<std::string>& words) {
    const auto& all = verbs();
    const auto verb = std::ranges::find(all, words.front(), &Verb::word);
    if (verb == all.end()) explain_usage("there is no '" + words.front() + "'");
    Json document = Json::object();
    document[verb->member] = value_of(*verb, words);
    return document;
}

void print(const std::string& sensor, const Json& replay) {
    std::cout << sensor << ": " << replay.at("state").get<std::string>() << ", scan "
              << replay.at("scan") << " of " << replay.at("scans") << ", at "
              << number(replay.at("at_s"), "%.3f") << " of "
              << number(replay.at("duration_s"), "%.3f") << " s, speed "
              << number(replay.at("speed"), "%g") << ", " << replay.at("file").get<std::string>()
              << "\n";
}

void answer(const ControlOptions& control, ReplayAsked& asked) {
    std::string said;
    if (!asked.words.empty() && could_be_sensor(asked.words.front())) {
        said = asked.words.front();
        asked.words.erase(asked.words.begin());
    }
    const std::optional<Json> wanted =
        asked.words.empty() ? std::nullopt : std::optional(steering(asked.words));
    ControlClient client(control.socket);
    const std::string sensor = choose_sensor(client, said);
    const std::string path = sensor_path(sensor) + "/replay";
    const Json replay = about_sensor(
        client, sensor, [&] { return wanted ? client.patch(path, *wanted) : client.get(path); });
    if (asked.json) {
        std::cout << json_text(replay) << "\n";
    } else {
        print(sensor, replay);
    }
}

}  // namespace

void add_replay_command(CLI::App& program, const ControlOptions& control) {
    const auto asked = std::make_shared<ReplayAsked>();
    auto* const command =
        program.add_subcommand("replay", "show or control the playback of a scanner's recording");
    command->add_option("WORDS", asked->words,
                        "[ROBOT/SENSOR] [seek SECONDS | step [SCANS] | pause | play | speed "
                        "FACTOR]; the name is not needed if there is only one scanner");
    command->add_flag("--json", asked->json, "as a JSON document");
    command->callback([&control, asked] { answer(control, *asked); });
    command->footer(
        "Examples:\n"
        "  scipctl replay robot/scanner\n"
        "  scipctl replay seek 12.5\n"
        "  scipctl replay robot/scanner step 10");
}

}  // namespace scipd::tools
