// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// load_config() of config.h: which keys there are and what must fit together. What a single value
// may be is in config_values, how faults are found and told in config_section.
#include "daemon/config.h"

#include <array>
#include <fstream>
#include <map>
#include <sstream>
#include <utility>

#include <yaml-cpp/depthguard.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include "daemon/config_section.h"
#include "daemon/config_values.h"
#include "daemon/demo_world.h"

namespace scipd::daemon {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t largest_file = 1 << 20;
constexpr std::size_t most_sensors = 4096;

constexpr std::array<std::string_view, 6> root_keys{"scene",  "seed",    "clock",
                                                    "robots", "control", "http"};
constexpr std::array<std::string_view, 2> later_root_keys{"materials", "map"};
constexpr std::array<std::string_view, 3> robot_keys{"pose", "poses", "sensors"};
constexpr std::array<std::string_view, 1> later_robot_keys{"body"};
constexpr std::array<std::string_view, 8> sensor_keys{"model",   "mount",    "tcp",    "pty",
                                                      "backend", "accuracy", "motion", "timing"};
constexpr std::array<std::string_view, 5> later_sensor_keys{"echo", "power_up", "clock", "link",
                                                            "profile"};
constexpr std::array<std::string_view, 2> pose_keys{"xyz", "rpy"};

/// What is no map at all is told elsewhere.
bool is_empty(const Field* map) {
    return !map || (map->value.IsMap() && map->value.size() == 0);
}

bool is_none(const Field* listener) {
    return !listener || (listener->value.IsScalar() && listener->value.Scalar() == "none");
}

/// Reads one document; what cannot be shared is remembered by who has it.
class Reader {
  public:
    Reader(const fs::path& file, Faults& faults)
        : base_(fs::absolute(file).parent_path()), faults_(faults) {}

    Config read(const YAML::Node& document);

  private:
    RobotConfig read_robot(const Field& field);
    SensorConfig read_sensor(const Field& field);
    sim::Pose read_pose(const Section& parent, std::string_view key);
    void claim(const Field* field, const std::string& what);
    void claim(const Field* field, const std::optional<Address>& address);

    /// A parser of paths, from the place of the file.
    template <class Parse>
    auto from_base(Parse parse) const {
        return [this, parse](const std::string& text) { return parse(text, base_); };
    }

    fs::path base_;
    Faults& faults_;
    std::size_t sensor_count_ = 0;
    std::map<std::string, std::string> owner_of_;
};

/// The field is the second to want the one thing: the first keeps it.
void Reader::claim(const Field* field, const std::string& what) {
    if (!field) return;
    const auto [owner, is_new] = owner_of_.emplace(what, field->path);
    if (!is_new) faults_.add(*field, what + " is taken by " + owner->second + "; use another");
}

void Reader::claim(const Field* field, const std::optional<Address>& address) {
    if (!address || address->port == 0) return;
    claim(field, address->host + ":" + std::to_string(address->port));
}

sim::Pose Reader::read_pose(const Section& parent, std::string_view key) {
    const Field* field = parent.find(key);
    if (!field) return {};
    const Section section{*field, {pose_keys, {}}, faults_};
    glm::dvec3 xyz_m{0.0};
    glm::dvec3 rpy_rad{0.0};
    section.read_vector("xyz", xyz_m, parse_metres);
    section.read_vector("rpy", rpy_rad, parse_radians);
    return sim::pose_from_rpy(xyz_m, rpy_rad);
}

SensorConfig Reader::read_sensor(const Field& field) {
    const Section section{field, {sensor_keys, later_sensor_keys}, faults_};
    SensorConfig sensor;
    faults_.guard(field, [&] { sensor.name = parse_name(field.key); });
    if (!section.find("model")) {
        faults_.add(field, "needs a model; `scipd --list-models` tells them");
    }
    section.read("model", sensor.model, parse_model);
    sensor.robot_from_sensor = read_pose(section, "mount");
    section.read("tcp", sensor.tcp, parse_listener);
    section.read("pty", sensor.pty, from_base(parse_pty));
    section.read("backend", sensor.backend, parse_backend);
    section.read("accuracy", sensor.accuracy, parse_accuracy);
    section.read("motion", sensor.motion, parse_motion);
    section.read("timing", sensor.timing, parse_timing);
    claim(section.find("tcp"), sensor.tcp);
    if (sensor.pty && !sensor.pty->link.empty()) claim(section.find("pty"), sensor.pty->link);
    if (is_none(section.find("tcp")) && is_none(section.find("pty"))) {
        faults_.add(field, "nobody can reach it; give tcp or pty, such as `pty: auto`");
    }
    return sensor;
}

RobotConfig Reader::read_robot(const Field& field) {
    const Section section{field, {robot_keys, later_robot_keys}, faults_};
    RobotConfig robot;
    faults_.guard(field, [&] { robot.name = parse_name(field.key); });
    robot.world_from_robot = read_pose(section, "pose");
    section.read("poses", robot.poses, from_base(parse_pose_source));
    if (robot.poses && robot.poses->kind == PoseSource::Kind::standard_input) {
        claim(section.find("poses"), "standard input");
    }
    const Field* sensors = section.find("sensors");
    const auto fields = sensors ? entries(*sensors, faults_) : std::vector<Field>{};
    sensor_count_ += fields.size();
    if (sensor_count_ > most_sensors) {
        faults_.add(field, "more than 4096 sensors in all; split them over several daemons");
        return robot;
    }
    if (is_empty(sensors)) {
        faults_.add(field, "needs at least one sensor, under sensors");
    }
    for (const Field& sensor : fields)
        robot.sensors.push_back(read_sensor(sensor));
    return robot;
}

Config Reader::read(const YAML::Node& document) {
    const Field whole{{}, {}, 1, document};
    const Section section{whole, {root_keys, later_root_keys}, faults_};
    Config config;
    if (section.find("scene")) {
        section.read("scene", config.scene, from_base(parse_file));
    } else {
        faults_.guard(whole, [&] { config.scene = demo_scene(); });
    }
    section.read("seed", config.seed, parse_seed);
    if (const Field* clock = section.find("clock")) {
        faults_.guard(*clock, [&] { check_clock(text_of(clock->value)); });
    }
    section.read("control", config.control, from_base(parse_socket));
    section.read("http", config.http, parse_listener);
    claim(section.find("http"), config.http);

    const Field* robots = section.find("robots");
    const auto fields = robots ? entries(*robots, faults_) : std::vector<Field>{};
    if (document.IsMap() && is_empty(robots)) {
        faults_.add(robots ? *robots : whole, "needs at least one robot, under robots");
    }
    for (const Field& robot : fields)
        config.robots.push_back(read_robot(robot));
    return config;
}

/// Hears a document and keeps only where it began.
class DocumentStart : public YAML::EventHandler {
  public:
    int line = 0;

  private:
    using Text = const std::string&;
    using Style = YAML::EmitterStyle::value;
    using Anchor = YAML::anchor_t;
    void OnDocumentStart(const YAML::Mark& mark) override { line = mark.line + 1; }
    void OnDocumentEnd() override {}
    void OnNull(const YAML::Mark&, Anchor) override {}
    void OnAlias(const YAML::Mark&, Anchor) override {}
    void OnScalar(const YAML::Mark&, Text, Anchor, Text) override {}
    void OnSequenceStart(const YAML::Mark&, Text, Anchor, Style) override {}
    void OnSequenceEnd() override {}
    void OnMapStart(const YAML::Mark&, Text, Anchor, Style) override {}
    void OnMapEnd() override {}
};

/// Not by YAML::LoadAll(): in yaml-cpp 0.7 it never ends on `!tag,`.
void refuse_second_document(const std::string& text, Faults& faults) {
    std::istringstream stream{text};
    YAML::Parser parser{stream};
    DocumentStart start;
    if (parser.HandleNextDocument(start) && parser.HandleNextDocument(start)) {
        faults.add(start.line, {}, "a second YAML document; keep one");
    }
}

/// The one document of the file; no text at all is an empty map.
YAML::Node parse_yaml(const std::string& text, Faults& faults) {
    try {
        auto document = YAML::Load(text);
        refuse_second_document(text, faults);
        return document.IsNull() ? YAML::Node{YAML::NodeType::Map} : document;
    } catch (const YAML::DeepRecursion& error) {
        faults.add(error.mark.line + 1, {}, "nested too deeply to be a configuration");
    } catch (const YAML::Exception& error) {
        faults.add(error.mark.line + 1, {}, "not YAML: " + error.msg);
    }
    faults.throw_if_any();
    return {};
}

}  // namespace

Config parse_config(const std::string& text, const fs::path& file) {
    Faults faults{file.string()};
    if (text.size() > largest_file) faults.add(1, {}, "larger than 1 MiB; split it");
    faults.throw_if_any();
    auto config = Reader{file, faults}.read(parse_yaml(text, faults));
    faults.throw_if_any();
    return config;
}

Config load_config(const fs::path& file) {
    std::ifstream stream{file, std::ios::binary};
    std::string text(largest_file + 1, '\0');
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    if (!stream.eof() && stream.gcount() == 0) {
        throw ConfigError({file.string() + ": cannot be read; is it there, and a file?"});
    }
    text.resize(static_cast<std::size_t>(stream.gcount()));
    return parse_config(text, file);
}

ConfigError::ConfigError(std::vector<std::string> faults)
    : std::runtime_error([&] {
          std::string text;
          for (const auto& fault : faults)
              text += (text.empty() ? "" : "\n") + fault;
          return text;
      }()),
      faults_(std::move(faults)) {}

}  // namespace scipd::daemon
