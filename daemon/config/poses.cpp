// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/config/poses.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "daemon/bridges/available.h"
#include "daemon/config/numbers.h"
#include "daemon/config/values.h"
#include "sim/text/likely_unit.h"
#include "sim/text/quote.h"

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

namespace fs = std::filesystem;

using sim::Expected;
using sim::quote;
using sim::refuse;

/// Characters that a topic of VDA 5050 may hold.
Expected<std::string> parse_vehicle(std::string_view text) {
    const auto slash = text.find('/');
    const std::string_view maker = text.substr(0, slash);
    const std::string_view serial = slash == text.npos ? "any" : text.substr(slash + 1);
    if (parse_name(maker) && parse_name(serial)) return std::string{text};
    return refuse(
        "must be vda5050:MANUFACTURER/SERIAL, or vda5050:MANUFACTURER of a robot that is "
        "called as the vehicle is, not " +
        quote(text));
}

/// A name of a topic, by the design of ROS ("Topic and Service Names").
Expected<std::string> parse_ros_topic(std::string_view text) {
    constexpr std::string_view legal =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_/";
    if (text.size() > 1 && text.size() <= 255 && text.front() == '/' && text.back() != '/' &&
        text.find("//") == text.npos && text.find_first_not_of(legal) == text.npos)
        return std::string{text};
    return refuse("must be a topic of ROS such as /odom, not " + quote(text));
}

/// Gazebo itself takes more; no world has it.
Expected<PoseSource> parse_gz(std::string_view text) {
    if (const auto built = check_gz_is_built(); !built) return tl::unexpected(built.error());
    const bool legal =
        text.empty() ||
        (text.size() > 1 && text.size() <= 255 && text.front() == '/' && text.back() != '/' &&
         text.find("//") == text.npos && text.find_first_of(" @~:=") == text.npos);
    if (!legal)
        return refuse("must be gz:/TOPIC, or gz: for the poses of the world that is loaded, not " +
                      quote(text));
    PoseSource source;
    source.kind = PoseSource::Kind::gz;
    source.topic = text;
    return source;
}

Expected<PoseSource> parse_ros2(std::string_view text) {
    return check_ros2_is_built()
        .and_then([&] { return parse_ros_topic(text); })
        .map([](auto topic) {
            return PoseSource{.kind = PoseSource::Kind::ros2,
                              .address = {},
                              .file = {},
                              .topic = std::move(topic)};
        });
}

/// ws://HOST:PORT/TOPIC
Expected<PoseSource> parse_rosbridge(std::string_view text) {
    constexpr std::string_view scheme = "ws://";
    const auto wrong = refuse(
        "must be rosbridge:ws://HOST:PORT/TOPIC such as "
        "rosbridge:ws://127.0.0.1:9090/odom, not " +
        quote(text));
    if (!text.starts_with(scheme)) return wrong;
    const std::string_view rest = text.substr(scheme.size());
    const auto slash = rest.find('/');
    const std::string_view where = rest.substr(0, slash);
    const auto colon = where.rfind(':');
    if (slash == rest.npos || colon == where.npos) return wrong;
    std::string_view host = where.substr(0, colon);
    if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
    const auto port = parse_integer<std::uint16_t>(where.substr(colon + 1));
    const auto topic = parse_ros_topic(rest.substr(slash));
    if (host.empty() || !port || *port == 0) return wrong;
    if (!topic) return tl::unexpected(topic.error());
    PoseSource source;
    source.kind = PoseSource::Kind::rosbridge;
    source.address = {std::string(host), *port};
    source.topic = *topic;
    return source;
}

/// "gazebo:" of gazebo:/poses.
std::string_view prefix_of(std::string_view text) {
    const auto colon = text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789");
    return colon != text.npos && text[colon] == ':' ? text.substr(0, colon + 1) : "";
}

/// A file may have a colon in its name. If there is none, the source is more likely misspelt.
Expected<PoseSource> parse_trajectory(std::string_view text, const fs::path& base) {
    const auto file = parse_file(text, base);
    const std::string_view prefix = prefix_of(text);
    if (!file && !prefix.empty() && !fs::exists(base / text))
        return refuse(file.error().why + ", and no source " + quote(prefix) +
                      "; there are udp:, gz:, ros2:, rosbridge: and vda5050:");
    return file.map([](const fs::path& path) {
        return PoseSource{.kind = PoseSource::Kind::file, .address = {}, .file = path};
    });
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

Expected<PoseSource> parse_pose_source(std::string_view text, const fs::path& base) {
    using Kind = PoseSource::Kind;
    if (text == "-") return PoseSource{.kind = Kind::standard_input, .address = {}, .file = {}};
    if (text.starts_with("udp:")) {
        const auto address = parse_address(text.substr(4));
        if (!address)
            return refuse("must be udp:ADDRESS:PORT such as udp:127.0.0.1:14550, not " +
                          quote(text));
        return PoseSource{.kind = Kind::udp, .address = *address, .file = {}};
    }
    if (text.starts_with("vda5050:")) {
        return parse_vehicle(text.substr(8)).map([](const std::string& vehicle) {
            return PoseSource{.kind = Kind::vda5050, .address = {}, .file = {}, .vehicle = vehicle};
        });
    }
    if (text.starts_with("gz:")) return parse_gz(text.substr(3));
    if (text.starts_with("rosbridge:")) return parse_rosbridge(text.substr(10));
    if (text.starts_with("ros2:")) return parse_ros2(text.substr(5));
    return parse_trajectory(text, base);
}

std::string text_of(const PoseSource& source) {
    switch (source.kind) {
        case PoseSource::Kind::udp:
            return "udp:" + text_of(source.address);
        case PoseSource::Kind::file:
            return source.file.string();
        case PoseSource::Kind::standard_input:
            return "-";
        case PoseSource::Kind::vda5050:
            return "vda5050:" + source.vehicle;
        case PoseSource::Kind::gz:
            return "gz:" + source.topic;
        case PoseSource::Kind::ros2:
            return "ros2:" + source.topic;
        case PoseSource::Kind::rosbridge:
            break;
    }
    return "rosbridge:ws://" + text_of(source.address) + source.topic;
}

}  // namespace scipd::daemon
