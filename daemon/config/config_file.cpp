// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The root of a document and its robots are read here. A sensor is read in sensor.cpp and a single
// value in values.cpp; section.cpp finds faults and tells them.
#include "daemon/config/config_file.h"

#include <array>
#include <initializer_list>
#include <optional>
#include <utility>

#include <yaml-cpp/yaml.h>

#include "daemon/config/claims.h"
#include "daemon/config/demo_world.h"
#include "daemon/config/doors.h"
#include "daemon/config/fleet.h"
#include "daemon/config/media.h"
#include "daemon/config/models.h"
#include "daemon/config/poses.h"
#include "daemon/config/run_directory.h"
#include "daemon/config/sensor.h"
#include "daemon/config/values.h"
#include "daemon/config/world_options.h"
#include "sim/loaders/file/load_error.h"
#include "sim/loaders/file/plain_file.h"
#include "sim/loaders/scene_file.h"
#include "sim/loaders/yaml/yaml_section.h"

namespace scipd::daemon {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t largest_file = 1 << 20;
constexpr std::size_t most_sensors = 4096;

constexpr std::array<std::string_view, 17> root_keys{
    "scene", "xacro", "geometry", "strict", "map",     "materials", "media", "scenario", "limits",
    "seed",  "clock", "models",   "robots", "control", "http",      "allow", "fleet"};
constexpr std::array<std::string_view, 4> robot_keys{"pose", "body", "poses", "sensors"};

/// Whether there is no such map or nothing in it. A value that is no map is told elsewhere.
bool is_empty(const sim::YamlField* map) {
    return !map || (map->value.IsMap() && map->value.size() == 0);
}

/// Reads one document, and remembers who has what cannot be shared.
class Reader {
  public:
    Reader(const fs::path& file, sim::YamlFaults& faults)
        : base_(fs::absolute(file).parent_path()), faults_(faults), claims_(faults) {
        claims_.claim_file("this configuration", fs::absolute(file));
    }

    Config read(const YAML::Node& document);

  private:
    RobotConfig read_robot(const sim::YamlField& field, SensorContext& context);
    void claim_sockets(const sim::YamlSection& section, const Config& config);
    /// Notes where these keys of the section stand.
    void note_places(const sim::YamlSection& section, std::initializer_list<std::string_view> keys);

    /// A parser of paths that are relative to the file.
    template <class Parse>
    auto from_base(Parse parse) const {
        return [this, parse](const std::string& text) { return parse(text, base_); };
    }

    fs::path base_;
    sim::YamlFaults& faults_;
    Claims claims_;
    std::map<std::string, std::string> places_;
    std::size_t sensor_count_ = 0;
    std::optional<sim::YamlField> needs_fleet_;  ///< poses that come by its broker
};

RobotConfig Reader::read_robot(const sim::YamlField& field, SensorContext& context) {
    const sim::YamlSection section{field, robot_keys, faults_};
    RobotConfig robot;
    faults_.take(field, parse_name(field.key), robot.name);
    context.robot = robot.name;
    note_places(section, {"body", "pose", "poses"});
    robot.world_from_robot = read_pose(section, "pose", faults_);
    robot.pose_given = section.find("pose") != nullptr;
    section.read("body", robot.body);
    const sim::YamlField* sensors = section.find("sensors");
    const auto fields =
        sensors ? entries(*sensors, faults_, ", such as sensors: {front: {model: UST-10LX}}")
                : std::vector<sim::YamlField>{};
    sensor_count_ += fields.size();
    if (sensor_count_ > most_sensors) {
        faults_.add(field, "more than 4096 sensors in all; split them over several daemons");
        return robot;
    }
    if (is_empty(sensors)) {
        faults_.add(field, "needs at least one sensor, under sensors");
    }
    for (const sim::YamlField& sensor : fields)
        robot.sensors.push_back(read_sensor(sensor, context));
    if (const sim::YamlField* poses = section.find("poses")) {
        read_poses(*poses, robot, base_, claims_, faults_);
        if (poses->value.IsMap() && poses->value["after"])
            places_[poses->path + ".after"] = faults_.place(poses->line, poses->path);
    }
    if (robot.poses && robot.poses->kind == PoseSource::Kind::vda5050)
        needs_fleet_ = *section.find("poses");
    return robot;
}

void Reader::claim_sockets(const sim::YamlSection& section, const Config& config) {
    claims_.claim(section.find("http"), Transport::tcp, config.http);
    claims_.claim_file("control", config.control.empty() ? usual_control_socket() : config.control);
}

void Reader::note_places(const sim::YamlSection& section,
                         std::initializer_list<std::string_view> keys) {
    for (const std::string_view key : keys) {
        const sim::YamlField* const field = section.find(key);
        if (field) places_[field->path] = faults_.place(field->line, field->path);
    }
}

Config Reader::read(const YAML::Node& document) {
    const sim::YamlField whole{{}, {}, 1, document};
    const sim::YamlSection section{whole, root_keys, faults_};
    Config config;
    if (section.find("scene")) {
        section.read("scene", config.scene, from_base(parse_scene));
    } else {
        faults_.take(whole, demo_scene(), config.scene);
    }
    section.read("geometry", config.geometry, parse_geometry);
    if (const sim::YamlField* xacro = section.find("xacro"))
        config.xacro = read_xacro(*xacro, faults_);
    section.read("strict", config.strict, parse_switch);
    if (const sim::YamlField* map = section.find("map")) config.map = read_map(*map, faults_);
    section.read("materials", config.materials, from_base(parse_file));
    if (const sim::YamlField* media = section.find("media"))
        config.media = read_media(*media, faults_);
    section.read("scenario", config.scenario, from_base(parse_file));
    if (const sim::YamlField* limits = section.find("limits"))
        read_limits(*limits, config, faults_);
    section.read("seed", config.seed, parse_seed);
    section.read("clock", config.clock, parse_clock);
    if (const sim::YamlField* control = section.find("control")) {
        read_control(*control, base_, config, faults_);
    }
    if (const sim::YamlField* http = section.find("http")) read_http(*http, base_, config, faults_);
    config.allow = {base_, sim::folder_of_scene(config.scene)};
    if (const sim::YamlField* allow = section.find("allow"))
        read_allow(*allow, base_, config, faults_);
    if (const sim::YamlField* fleet = section.find("fleet"))
        read_fleet(*fleet, base_, config, faults_);
    claim_sockets(section, config);
    note_places(section, {"scene", "materials", "media", "scenario", "fleet"});

    const ModelChoice models{section.find("models"), faults_};
    SensorContext context{models, claims_, base_, faults_, places_};
    const sim::YamlField* robots = section.find("robots");
    const auto fields =
        robots ? entries(*robots, faults_,
                         ", such as robots: {cart: {sensors: {front: {model: UST-10LX}}}}")
               : std::vector<sim::YamlField>{};
    if (document.IsMap() && is_empty(robots)) {
        faults_.add(robots ? *robots : whole, "needs at least one robot, under robots");
    }
    for (const sim::YamlField& robot : fields)
        config.robots.push_back(read_robot(robot, context));
    if (needs_fleet_ && !config.fleet)
        faults_.add(*needs_fleet_, "needs fleet, by whose broker vehicles tell where they are");
    if (!section.find("scene") && config.only_plays()) config.scene.clear();
    config.places = std::move(places_);
    config.warnings = faults_.warnings();
    return config;
}

}  // namespace

std::span<const std::string_view> configuration_keys() {
    return root_keys;
}

Config parse_config(const std::string& text, const fs::path& file) {
    sim::YamlFaults faults{file.string()};
    if (text.size() > largest_file) faults.add(1, {}, "larger than 1 MiB; split it");
    faults.throw_if_any();
    auto config = Reader{file, faults}.read(sim::parse_yaml(text, "a configuration", faults));
    faults.throw_if_any();
    config.file = fs::absolute(file);
    config.document = text;
    return config;
}

Config load_config(const fs::path& file) {
    return parse_config(sim::read_file(file, largest_file, "name a configuration of at most 1 MiB"),
                        file);
}

}  // namespace scipd::daemon
