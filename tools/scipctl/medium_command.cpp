// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// scipctl scene medium: what fills the air of the world.
#include <algorithm>
#include <iomanip>
#include <iostream>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "tools/control_client.h"
#include "tools/options.h"
#include "tools/scipctl/scipctl_commands.h"
#include "tools/scipctl/table.h"

namespace scipd::tools {
namespace {

using Json = ControlClient::Json;

constexpr const char* media_path = "/scene/media";

/// An option that is a number of a medium.
struct NumberOption {
    const char* flag;
    const char* key;  ///< in JSON
    double least;
    double most;
    const char* help;
};

constexpr NumberOption number_options[] = {
    {"--visibility", "visibility_m", 0.5, 1e5, "fog and dust: visibility in m"},
    {"--rate", "mm_per_hour", 0.0, 500.0, "rain and snow: precipitation as water, in mm per hour"},
    {"--extinction", "extinction_per_m", 0.0, 100.0,
     "custom: exp(-EXTINCTION R) of the light is left after R metres"},
    {"--returns", "returns_per_m", 0.0, 1000.0,
     "custom: number of drops that a beam meets per metre"},
    {"--brightness", "brightness", 0.0, 10.0,
     "custom: reflectivity of a drop, 1 for that of a white wall"},
};

/// The options that each kind has; it needs the first.
const std::map<std::string, std::vector<std::string>> flags_of{
    {"fog", {"--visibility"}},
    {"dust", {"--visibility"}},
    {"rain", {"--rate"}},
    {"snow", {"--rate"}},
    {"custom", {"--extinction", "--returns", "--brightness"}},
};

struct MediumOptions {
    std::string kind;  ///< empty: list them
    std::string bare;  ///< number given without its option
    std::string name;
    std::map<std::string, double> numbers;  ///< of the options that were given, by flag
    std::vector<double> box_m;
    bool json = false;
};

/// "[1,2,0]" as "1,2,0"
std::string corner_text(const Json& corner) {
    std::ostringstream text;
    text << std::setprecision(6) << corner[0].get<double>() << ',' << corner[1].get<double>() << ','
         << corner[2].get<double>();
    return text.str();
}

/// "visibility 20 m"
std::string numbers_text(const Json& medium) {
    static constexpr struct {
        const char* key;
        const char* before;
        const char* after;
    } words[] = {{"visibility_m", "visibility ", " m"},
                 {"mm_per_hour", "", " mm an hour"},
                 {"extinction_per_m", "extinction ", " a metre"},
                 {"returns_per_m", ", returns ", " a metre"},
                 {"brightness", ", brightness ", ""}};
    std::ostringstream text;
    text << std::setprecision(6);
    for (const auto& [key, before, after] : words) {
        if (medium.contains(key)) text << before << medium.at(key).get<double>() << after;
    }
    return text.str();
}

void list(ControlClient& client, bool json) {
    const Json media = client.get(media_path);
    if (json) return void(std::cout << json_text(media, 2) << '\n');
    if (media.empty()) return void(std::cout << "the air is clear\n");
    std::vector<Row> rows{{"NAME", "KIND", "HOW MUCH", "WHERE"}};
    for (const Json& medium : media) {
        const bool in_box = medium.contains("box");
        rows.push_back({medium.at("name"), medium.at("kind"), numbers_text(medium),
                        in_box ? corner_text(medium.at("box").at("from")) + " to " +
                                     corner_text(medium.at("box").at("to"))
                               : "everywhere"});
    }
    print_table(std::cout, rows);
}

Json box_of(const std::vector<double>& box_m) {
    Json from = Json::array();
    Json to = Json::array();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto [low_m, high_m] = std::minmax(box_m[axis], box_m[axis + 3]);
        from.push_back(low_m);
        to.push_back(high_m);
    }
    return {{"from", from}, {"to", to}};
}

Json medium_of(const MediumOptions& options) {
    Json medium{{"kind", options.kind},
                {"name", options.name.empty() ? options.kind : options.name}};
    const std::vector<std::string>& its_own = flags_of.at(options.kind);
    for (const auto& [flag, key, least, most, help] : number_options) {
        const auto given = options.numbers.find(flag);
        if (given == options.numbers.end()) continue;
        if (std::ranges::find(its_own, flag) == its_own.end())
            throw WrongInput(options.kind + " has no " + flag + "; it has " + its_own.front());
        medium[key] = given->second;
    }
    if (!options.numbers.contains(its_own.front()))
        throw WrongInput(options.kind + " needs " + its_own.front());
    if (!options.box_m.empty()) medium["box"] = box_of(options.box_m);
    return medium;
}

auto find_named(Json& media, const Json& name) {
    return std::ranges::find_if(media, [&](const Json& medium) { return medium["name"] == name; });
}

void send(ControlClient& client, const Json& media) {
    const Json answer = client.load(media_path, media);
    for (const auto& note : answer.value("notes", Json::array()))
        std::cerr << "note: " << note.get<std::string>() << '\n';
}

/// Puts it in the place of the one of its name, or behind all others.
void set(ControlClient& client, const Json& medium) {
    Json media = client.get(media_path);
    const auto found = find_named(media, medium["name"]);
    if (found == media.end()) {
        media.push_back(medium);
    } else {
        *found = medium;
    }
    send(client, media);
}

void clear(ControlClient& client, const std::string& name) {
    if (name.empty()) return client.remove(media_path);
    Json media = client.get(media_path);
    const auto found = find_named(media, name);
    if (found == media.end())
        throw ControlError(404,
                           "there is no medium \"" + name + "\"; scipctl scene medium lists them");
    media.erase(found);
    send(client, media);
}

void run_medium(const ControlOptions& control, const MediumOptions& options) {
    const bool makes_one = flags_of.contains(options.kind);
    if (!options.bare.empty())
        throw WrongInput("unexpected argument '" + options.bare + "'" +
                         (makes_one
                              ? "; did you mean " + options.kind + " " +
                                    flags_of.at(options.kind).front() + " " + options.bare + "?"
                              : ""));
    if (!makes_one && (!options.numbers.empty() || !options.box_m.empty()))
        throw WrongInput("name the medium before its options, such as: fog --visibility 20");
    if (options.kind.empty() && !options.name.empty())
        throw WrongInput("name the kind of medium, such as: fog --visibility 20 --name mist");
    ControlClient client(control.socket);
    if (makes_one) return set(client, medium_of(options));
    if (options.kind == "none") return clear(client, options.name);
    list(client, options.json);
}

}  // namespace

void add_medium_command(CLI::App& scene, const ControlOptions& control) {
    auto* const command =
        scene.add_subcommand("medium", "list the media in the air, or add rain, fog, snow or dust");
    const auto options = std::make_shared<MediumOptions>();
    command
        ->add_option("KIND", options->kind,
                     "fog, dust, rain, snow or custom; none clears the air; without it, a list")
        ->check(CLI::IsMember({"fog", "dust", "rain", "snow", "custom", "none"}));
    command->add_option("NUMBER", options->bare)->group("");
    for (const auto& [flag, key, least, most, help] : number_options) {
        command
            ->add_option_function<double>(
                flag, [options, name = flag](double value) { options->numbers[name] = value; },
                help)
            ->check(number_within(least, most));
    }
    command
        ->add_option("--box", options->box_m,
                     "two corners of the box that it fills; without it, everywhere")
        ->type_name("X,Y,Z,X,Y,Z")
        ->delimiter(',')
        ->expected(6)
        ->check(number_within(-1e7, 1e7));
    command->add_option("--name", options->name,
                        "its name, which replaces a medium of the same name; default: the kind. "
                        "With none: the medium to remove");
    command->add_flag("--json", options->json, "the list as a JSON document");
    command->callback([&control, options] { run_medium(control, *options); });
    command->footer(
        "Scanners with accuracy: material see it from their next scan on.\n"
        "Examples:\n"
        "  scipctl scene medium rain --rate 10\n"
        "  scipctl scene medium fog --visibility 5 --box 0,0,0,3,2,2.5 --name corner\n"
        "  scipctl scene medium none --name corner");
}

}  // namespace scipd::tools
