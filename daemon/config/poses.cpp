// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/config/poses.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "daemon/config/numbers.h"
#include "daemon/config/pose_source.h"
#include "daemon/config/values.h"
#include "sim/text/likely_unit.h"

namespace scipd::daemon {
namespace {

constexpr std::array<std::string_view, 12> poses_keys{"from",     "before",  "after", "stale_s",
                                                      "jump_mps", "wait_ms", "speed", "loop",
                                                      "format",   "times",   "gz",    "ros2"};
constexpr std::array<std::string_view, 1> gz_keys{"robot"};
constexpr std::array<std::string_view, 3> ros_keys{"topic", "parent", "child"};

using After = sim::PosePolicy::After;

sim::Expected<After> parse_after(std::string_view text) {
    if (text == "hold") return After::hold;
    if (text == "extrapolate") return After::extrapolate;
    if (text == "none") return After::absent;
    return sim::refuse("must be hold, extrapolate or none, not '" + std::string(text) + "'");
}

sim::Expected<bool> parse_absent_before(std::string_view text) {
    if (text == "hold" || text == "none") return text == "none";
    return sim::refuse("must be hold or none, not '" + std::string(text) + "'");
}

sim::Expected<sim::TrajectoryFormat> parse_format(std::string_view text) {
    using Format = sim::TrajectoryFormat;
    if (text == "tum") return Format::tum;
    if (text == "euroc") return Format::euroc;
    if (text == "kitti") return Format::kitti;
    if (text == "csv") return Format::csv;
    return sim::refuse("must be tum, euroc, kitti or csv, not '" + std::string(text) +
                       "'; leave it out to go by the content");
}

void refuse_of_live_poses(const sim::YamlSection& section, const RobotConfig& robot,
                          sim::YamlFaults& faults) {
    if (!robot.poses || robot.poses->kind == PoseSource::Kind::file) return;
    for (const std::string_view key : {"speed", "loop", "format", "times"}) {
        if (const sim::YamlField* field = section.find(key))
            faults.add(*field, "is of a trajectory; live poses come when they come");
    }
}

void read_of_trajectory(const sim::YamlSection& section, const std::filesystem::path& base,
                        PoseSource& source) {
    section.read("speed", source.speed, parse_speed);
    section.read("loop", source.loop, parse_switch);
    section.read("format", source.format, parse_format);
    section.read("times", source.times,
                 [&](const std::string& text) { return parse_file(text, base); });
}

sim::Expected<std::string> parse_frame(std::string_view text) {
    if (!text.empty() && text.size() <= 255) return std::string(text);
    return sim::refuse("must be the name of a frame, such as base_link");
}

sim::Expected<std::string> parse_called(std::string_view text) {
    if (!text.empty() && text.size() <= 255) return std::string(text);
    return sim::refuse("must be a name of Gazebo, such as rescue or rescue::base_link");
}

/// `gz: {robot: rescue::base_link}`
void read_gz(const sim::YamlSection& section, std::optional<PoseSource>& source,
             sim::YamlFaults& faults) {
    const sim::YamlField* field = section.find("gz");
    if (!field || !source) return;
    if (source->kind != PoseSource::Kind::gz) return faults.add(*field, "goes with from: gz:");
    const sim::YamlSection keys{*field, gz_keys, faults};
    keys.read("robot", source->called, parse_called);
}

/// `ros2: {topic: /tf, parent: odom, child: base_link}`; the topic may stand under from, too.
void read_ros(const sim::YamlSection& section, std::optional<PoseSource>& source,
              sim::YamlFaults& faults) {
    const sim::YamlField* field = section.find("ros2");
    if (!field) return;
    const bool other = source && source->kind != PoseSource::Kind::ros2 &&
                       source->kind != PoseSource::Kind::rosbridge;
    if (other) return faults.add(*field, "goes with from: ros2:/TOPIC, or rosbridge:");
    const sim::YamlSection keys{*field, ros_keys, faults};
    const bool bridged = source && source->kind == PoseSource::Kind::rosbridge;
    if (const sim::YamlField* topic = keys.find("topic"); topic && bridged)
        faults.add(*topic, "stands in from already");
    else if (topic)
        faults.take(*topic, sim::text_of(topic->value).and_then([](const std::string& text) {
            return parse_pose_source("ros2:" + text, {});
        }),
                    source);
    if (!source && !section.find("from") && !keys.find("topic"))
        return faults.add(*field, "needs topic: /TOPIC");
    if (!source) return;
    keys.read("parent", source->frames.parent, parse_frame);
    keys.read("child", source->frames.child, parse_frame);
}

}  // namespace

sim::Pose pose_in(const sim::YamlSection& section, sim::YamlFaults& faults) {
    glm::dvec3 xyz_m{0.0};
    glm::dvec3 rpy_rad{0.0};
    section.read_vector("xyz", xyz_m, parse_metres);
    section.read_vector("rpy", rpy_rad, parse_radians);
    const std::array angles{rpy_rad.x, rpy_rad.y, rpy_rad.z};
    if (const auto warning = sim::degrees_for_radians(angles))
        faults.warn(*section.find("rpy"), *warning);
    return sim::pose_from_rpy(xyz_m, rpy_rad);
}

sim::Pose read_pose(const sim::YamlSection& parent, std::string_view key, sim::YamlFaults& faults) {
    static constexpr std::array<std::string_view, 2> keys{"xyz", "rpy"};
    const sim::YamlField* field = parent.find(key);
    if (!field) return {};
    return pose_in(
        sim::YamlSection{*field, keys, faults, "pose: {xyz: [1, 2, 0], rpy: [0, 0, 1.57]}"},
        faults);
}

void read_poses(const sim::YamlField& field, RobotConfig& robot, const std::filesystem::path& base,
                Claims& claims, sim::YamlFaults& faults) {
    const auto parse = [&](const std::string& text) { return parse_pose_source(text, base); };
    const sim::YamlField* source = &field;
    std::optional<sim::YamlSection> section;
    if (field.value.IsMap()) {
        section.emplace(field, poses_keys, faults);
        source = section->find("from");
        if (!source && !section->find("ros2"))
            return faults.add(field, "needs from: udp:ADDR:PORT, a trajectory or -");
    }
    if (source) faults.take(*source, sim::text_of(source->value).and_then(parse), robot.poses);
    if (section) {
        read_gz(*section, robot.poses, faults);
        read_ros(*section, robot.poses, faults);
    }
    if (robot.poses && robot.poses->kind == PoseSource::Kind::standard_input)
        claims.claim(source, "standard input");
    if (robot.poses && robot.poses->kind == PoseSource::Kind::udp)
        claims.claim(source, Transport::udp, robot.poses->address);
    if (!section) return;
    section->read("before", robot.policy.absent_before, parse_absent_before);
    section->read("after", robot.policy.after, parse_after);
    section->read("stale_s", robot.policy.stale_after, parse_stale);
    section->read("jump_mps", robot.policy.fastest_mps, parse_fastest);
    std::chrono::nanoseconds wait{};
    section->read("wait_ms", wait, parse_wait);
    for (SensorConfig& sensor : robot.sensors)
        sensor.wait_for_poses = wait;
    PoseSource unknown;
    read_of_trajectory(*section, base, robot.poses ? *robot.poses : unknown);
    refuse_of_live_poses(*section, robot, faults);
}

// Standard input may be a recording that another program sends at once.
sim::PosePolicy pose_policy(const Config& config, const RobotConfig& robot) {
    using Kind = PoseSource::Kind;
    constexpr std::array live{Kind::udp, Kind::gz, Kind::ros2, Kind::rosbridge};
    sim::PosePolicy policy = robot.policy;
    const bool is_said = config.places.contains("robots." + robot.name + ".poses.after");
    if (!is_said && config.clock == ClockKind::wall && robot.poses &&
        std::ranges::find(live, robot.poses->kind) != live.end())
        policy.after = After::extrapolate;
    return policy;
}

}  // namespace scipd::daemon
