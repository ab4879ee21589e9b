// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "daemon/config/demo_world.h"
#include "daemon/config/values.h"
#include "sim/text/quote.h"
#include "tools/options.h"
#include "tools/output_file.h"
#include "tools/scipfit/fit_report.h"
#include "tools/scipfit/known_length.h"
#include "tools/scipfit/room_report.h"
#include "tools/scipfit/scipfit_commands.h"

namespace scipd::tools {
namespace {

struct FitOptions {
    std::vector<std::filesystem::path> files;
    std::string stream;
    std::string model;
    std::vector<std::string> lengths;
    std::filesystem::path world;
    std::vector<std::string> poses;
    std::string output;
    std::string room;
    std::string report;
    bool json = false;
};

/// The profile has the light of a white wall as the room tells it.
void take_light(const Room& room, Fit& found) {
    if (!room.light) return;
    found.light.by_range = room.light->white;
    found.light.of_what = "of walls that are bright among these";
}

/// A room or a world as the profile names it: a configuration names files from where it lies.
std::string beside_profile(const std::filesystem::path& scene, const FitOptions& options) {
    const auto folder = std::filesystem::absolute(options.output).parent_path();
    return std::filesystem::absolute(scene).lexically_relative(folder).string();
}

/// Where the profile has its scanner stand: in a world where the first station was found to be.
Surroundings surroundings_of(const FitOptions& options, const Standing& standing,
                             const Fit& found) {
    if (!options.room.empty()) return {beside_profile(options.room, options), std::nullopt};
    if (!found.calibration || !found.calibration->by_world) return {};
    const auto first = std::ranges::min_element(standing.stations, {}, &Station::first);
    const auto index = static_cast<std::size_t>(first - standing.stations.begin());
    return {beside_profile(options.world, options), found.calibration->fit.places[index]};
}

FlatPose parse_flat_pose(const std::string& text) {
    constexpr double hardly_rad = 1e-6;
    constexpr double mm = 1000.0;
    const auto pose = daemon::parse_pose(text);
    if (!pose) throw WrongInput("--pose: " + pose.error().why);
    const glm::dquat& turn = pose->rotation;
    if (std::hypot(turn.x, turn.y) > hardly_rad)
        throw WrongInput("--pose: " + sim::quote(text) +
                         ": scipfit knows scanners that stand upright; roll and pitch must be 0");
    const glm::dvec3& at = pose->translation_m;
    return {mm * at.x, mm * at.y, 2.0 * std::atan2(turn.z, turn.w), mm * at.z};
}

/// Empty where they are missing: surfaces are then matt and white unless the world says more.
std::filesystem::path stock_materials() {
    return daemon::stock_materials().value_or(std::filesystem::path());
}

void check(const FitOptions& options) {
    if (options.files.empty()) throw WrongInput("name a recording");
    if (options.poses.empty() != options.world.empty())
        throw WrongInput(options.world.empty()
                             ? "--pose needs the world that it refers to: --world"
                             : "--world needs the scanner's pose in it: --pose X,Y,YAW");
    if (!options.world.empty() && !options.lengths.empty())
        throw WrongInput("--length: a world has all lengths; leave out --length or --world");
    if (!options.world.empty() && !options.room.empty())
        throw WrongInput("--room: the profile is placed in --world; leave out one of them");
}

/// By station: one for each, or one for each recording, in the order of time.
std::vector<FlatPose> places_of(const Standing& standing, const std::vector<FlatPose>& poses) {
    const std::vector<Station>& stations = standing.stations;
    const std::vector<std::size_t>& begins = standing.readings->begins;
    const bool by_station = poses.size() == stations.size();
    if (!by_station && poses.size() + 1 != begins.size())
        throw WrongInput("--pose: there are " + std::to_string(poses.size()) + ", but " +
                         std::to_string(begins.size() - 1) + " recordings and " +
                         std::to_string(stations.size()) +
                         " stations; give one for each, in the order of time");
    std::vector<FlatPose> places;
    for (const Station& station : stations) {
        const auto earlier = std::ranges::count_if(
            stations, [&](const Station& other) { return other.first < station.first; });
        const auto recording = std::ranges::upper_bound(begins, station.first) - begins.begin() - 1;
        places.push_back(poses[static_cast<std::size_t>(by_station ? earlier : recording)]);
    }
    return places;
}

void tell(const Fit& found, const std::optional<Room>& room, bool json) {
    if (!json) {
        show(found, std::cout);
        if (room) std::cout << as_text(*room);
        return;
    }
    auto document = as_json(found);
    if (room) document["room"] = as_json(*room);
    std::cout << document.dump(2, ' ', true, nlohmann::json::error_handler_t::replace) << '\n';
}

void fit(const FitOptions& options) {
    check(options);
    Given given;
    for (const std::string& length : options.lengths)
        given.lengths.push_back(parse_length_between(length));
    std::vector<FlatPose> poses;
    for (const std::string& pose : options.poses)
        poses.push_back(parse_flat_pose(pose));
    std::optional<KnownWorld> world;
    if (!options.world.empty())
        given.world = &world.emplace(
            load_known_world(options.world, daemon::stock_models(), stock_materials()));
    ScanTable readings;
    for (const std::filesystem::path& file : options.files)
        read_scans(*open_recorded(file.string()), file.string(),
                   {.stream = options.stream, .echo = Echo::brightest}, readings);
    const Kind kind = kind_of(readings, options.model);
    complete(*kind.model, readings);
    const Standing standing = look_at(readings);
    if (world) given.places = places_of(standing, poses);
    Fit found = fit_scanner(standing, kind, given);
    std::optional<Room> room;
    if (!options.room.empty()) {
        room = room_of(standing);
        take_light(*room, found);
        write_to(options.room,
                 [&](std::ostream& out) { write_room(*room, readings, *kind.model, out); });
    }
    write_to(options.output, [&](std::ostream& out) {
        write_profile(found, surroundings_of(options, standing, found), out);
    });
    write_to(options.report, [&](std::ostream& out) { out << as_html(standing, found, room); });
    tell(found, room, options.json);
}

}  // namespace

void add_fit_options(CLI::App& program) {
    const auto options = std::make_shared<FitOptions>();
    program.add_option(
        "RECORDING", options->files,
        "recordings of one stationary scanner, in any format that scipcat info knows");
    program
        .add_option("-o,--output", options->output,
                    "the profile: a configuration for scipd, with the origin of each value")
        ->type_name("FILE.yaml")
        ->check(can_be_written);
    program
        .add_option(
            "--room", options->room,
            "also write the room, with the scanner of the profile in it: a twin at its place")
        ->type_name("FILE.sdf")
        ->check(can_be_written);
    program
        .add_option("--report", options->report,
                    "an HTML report: the noise beside the twin's, the quality of the noise model, "
                    "and what is not identifiable")
        ->type_name("FILE.html")
        ->check(can_be_written);
    program.add_option("--stream", options->stream,
                       "scanner to use, of recordings of several; default: the first");
    program
        .add_option("--model", options->model,
                    "model of the scanner; default: that of the recording, or the nearest")
        ->type_name("MODEL");
    program
        .add_option("--length", options->lengths,
                    "measured length between what two steps see, such as 180:900=3.2m; may be "
                    "given more than once")
        ->type_name("STEP:STEP=METRES");
    program
        .add_option(
            "--world", options->world,
            "reference world, in a format of scipd --scene; enables estimation of range bias")
        ->type_name("FILE")
        ->check(CLI::ExistingPath);
    program
        .add_option("--pose", options->poses,
                    "pose of the scanner in that world, known to about 10 mm and one degree; one "
                    "for each recording or viewpoint, in the order of time")
        ->type_name("X,Y,YAW");
    program.add_flag("--json", options->json, "as a JSON document");
    program.callback([options, &program] {
        if (!program.get_subcommands().empty()) return;
        fit(*options);
    });
}

}  // namespace scipd::tools
