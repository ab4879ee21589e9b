// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/config/saved_config.h"

#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <initializer_list>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <yaml-cpp/yaml.h>

#include "daemon/config/media.h"
#include "daemon/config/poses.h"
#include "daemon/config/reading_errors.h"
#include "daemon/config/values.h"

namespace scipd::daemon {
namespace {

namespace fs = std::filesystem;

/// The shortest text that is this number again.
std::string text_of(double number) {
    std::array<char, 32> digits{};
    return {digits.data(), std::to_chars(digits.begin(), digits.end(), number).ptr};
}

YAML::Node list_of(std::initializer_list<double> numbers) {
    YAML::Node list{YAML::NodeType::Sequence};
    for (const double number : numbers)
        list.push_back(text_of(number));
    list.SetStyle(YAML::EmitterStyle::Flow);
    return list;
}

/// Without anchors: what two keys share would change at both.
YAML::Node copy_of(const YAML::Node& node) {
    if (node.IsMap()) {
        YAML::Node map{YAML::NodeType::Map};
        for (const auto& entry : node)
            map[entry.first.Scalar()] = copy_of(entry.second);
        map.SetStyle(node.Style());
        return map;
    }
    if (node.IsSequence()) {
        YAML::Node list{YAML::NodeType::Sequence};
        for (const auto& item : node)
            list.push_back(copy_of(item));
        list.SetStyle(node.Style());
        return list;
    }
    return YAML::Clone(node);
}

/// About the fixed axes, as pose_from_rpy() takes them.
glm::dvec3 rpy_of(const glm::dquat& q) {
    const glm::dmat3 m = glm::mat3_cast(q);
    const double level = std::hypot(m[0][0], m[0][1]);
    constexpr double upright = 1e-9;
    if (level < upright) return {std::atan2(-m[2][1], m[1][1]), std::atan2(-m[0][2], level), 0.0};
    return {std::atan2(m[1][2], m[2][2]), std::atan2(-m[0][2], level),
            std::atan2(m[0][1], m[0][0])};
}

YAML::Node node_of(const sim::Pose& pose) {
    YAML::Node map;
    const glm::dvec3& xyz = pose.translation_m;
    const glm::dvec3 rpy = rpy_of(pose.rotation);
    map["xyz"] = list_of({xyz.x, xyz.y, xyz.z});
    map["rpy"] = list_of({rpy.x, rpy.y, rpy.z});
    return map;
}

YAML::Node node_of(const sim::Medium& medium) {
    YAML::Node map;
    map["kind"] = medium.kind;
    map["name"] = medium.name;
    if (const std::string_view key = amount_key(medium.kind); !key.empty()) {
        map[std::string(key)] = text_of(medium.amount);
    } else {
        map["extinction_per_m"] = text_of(medium.extinction_per_m);
        map["returns_per_m"] = text_of(medium.returns_per_m);
        map["brightness"] = text_of(medium.brightness);
    }
    if (!std::isfinite(medium.low_m.x)) return map;
    map["box"]["from"] = list_of({medium.low_m.x, medium.low_m.y, medium.low_m.z});
    map["box"]["to"] = list_of({medium.high_m.x, medium.high_m.y, medium.high_m.z});
    return map;
}

YAML::Node bias_of(const ReadingErrors& errors) {
    if (!errors.own_bias) return YAML::Node{"unit"};
    if (errors.bias.empty()) return YAML::Node{"none"};
    YAML::Node list{YAML::NodeType::Sequence};
    for (const auto& [range_m, bias_m] : errors.bias) {
        YAML::Node point;
        point["range_m"] = text_of(range_m);
        point["bias_m"] = text_of(bias_m);
        list.push_back(point);
    }
    return list;
}

std::string model_of(const SensorConfig& sensor) {
    const auto& profile = sensor.model.profile;
    const std::string exact = profile.name + "@" + profile.release;
    return parse_model(exact) ? exact : profile.name;
}

/// Where nothing was said in a file, it was said by options.
void say_options(const SensorConfig& sensor, YAML::Node said) {
    said["backend"] = sensor.backend;
    if (sensor.staring) return;
    if (!sensor.replay || !sensor.replay->finds_model) said["model"] = model_of(sensor);
    said["timing"] = sensor.timing == Timing::real ? "real" : "ideal";
    if (sensor.power_up == PowerUp::boot) said["power_up"] = "boot";
    if (sensor.power_up == PowerUp::scip1) said["power_up"] = "scip1.1";
}

void say_replay(const ReplayConfig& replay, YAML::Node said) {
    if (!said["replay"].IsMap()) said["replay"] = YAML::Node{YAML::NodeType::Map};
    const bool single = replay.files.size() == 1;
    YAML::Node files{single ? YAML::Node{replay.files.front().string()} : YAML::Node{}};
    for (std::size_t i = 0; !single && i < replay.files.size(); ++i)
        files.push_back(replay.files[i].string());
    said["replay"]["file"] = files;
    if (!replay.stream.empty()) said["replay"]["stream"] = replay.stream;
    if (replay.loop == ReplayLoop::again) said["replay"]["loop"] = "true";
    if (replay.loop == ReplayLoop::on) said["replay"]["loop"] = "on";
}

void say(const SensorConfig& sensor, bool by_options, YAML::Node said) {
    if (by_options) say_options(sensor, said);
    // The lidar of a world said which model; here it is mounted by numbers.
    if (sensor.mount && sensor.mount->chooses_model) said["model"] = model_of(sensor);
    said["mount"] = node_of(sensor.robot_from_sensor);
    said["accuracy"] = std::string(name_of(sensor.accuracy));
    if (sensor.staring) return;
    said["noise"] = text_of(sensor.noise);
    said["interference"] = sensor.interference ? "true" : "false";
    said["bias"] = bias_of(errors_of(sensor));
    said["tcp"] = sensor.tcp ? text_of(*sensor.tcp) : "none";
    const bool is_auto = sensor.pty && sensor.pty->link.empty();
    said["pty"] = !sensor.pty ? "none" : is_auto ? "auto" : sensor.pty->link.string();
    if (sensor.replay) say_replay(*sensor.replay, said);
}

void say_poses(const PoseSource& source, YAML::Node robot) {
    YAML::Node said = robot["poses"];
    if (!said.IsMap()) {
        robot["poses"] = text_of(source);
        return;
    }
    // With the topic under ros2 there is none.
    if (said["from"]) said["from"] = text_of(source);
    if (said["times"]) said["times"] = source.times.string();
}

void say(const RobotConfig& robot, bool by_options, YAML::Node said) {
    said["pose"] = node_of(robot.world_from_robot);
    if (!robot.body.empty()) said["body"] = robot.body;
    if (robot.poses && robot.poses->kind != PoseSource::Kind::vda5050) {
        say_poses(*robot.poses, said);
    } else {
        said.remove("poses");
    }
    for (const SensorConfig& sensor : robot.sensors)
        say(sensor, by_options, said["sensors"][sensor.name]);
}

void say_path(const fs::path& path, const char* key, YAML::Node root) {
    root.remove(key);
    if (!path.empty()) root[key] = path.string();
}

void say_http(const Config& config, YAML::Node root) {
    const YAML::Node before = root["http"];
    const bool has_file = before && before.IsMap() && before["token_file"];
    const std::string file = has_file ? before["token_file"].Scalar() : std::string{};
    root.remove("http");
    if (!config.http) return;
    if (config.http_token.empty()) {
        root["http"] = text_of(*config.http);
    } else {
        root["http"]["listen"] = text_of(*config.http);
        root["http"]["token_file"] = (config.file.parent_path() / file).string();
    }
}

}  // namespace

std::string saved_config(const Config& config, const std::string& scene) {
    const bool by_options = config.document.empty();
    YAML::Node root =
        by_options ? YAML::Node{YAML::NodeType::Map} : copy_of(YAML::Load(config.document));
    for (const char* const key : {"control", "allow", "fleet", "geometry", "map", "scene", "xacro"})
        root.remove(key);
    if (!config.scene.empty()) root["scene"] = scene;
    say_path(config.materials, "materials", root);
    say_path(config.scenario, "scenario", root);
    root["seed"] = std::to_string(config.seed);
    root["clock"] = config.clock == ClockKind::wall ? "wall" : "poses";
    say_http(config, root);
    root.remove("media");
    for (const sim::Medium& medium : config.media)
        root["media"].push_back(node_of(medium));
    for (const RobotConfig& robot : config.robots)
        say(robot, by_options, root["robots"][robot.name]);
    YAML::Emitter out;
    out << root;
    return std::string(out.c_str()) + "\n";
}

}  // namespace scipd::daemon
