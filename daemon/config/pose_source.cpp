// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/config/pose_source.h"

#include <cstdint>
#include <string>
#include <utility>

#include "daemon/bridges/available.h"
#include "daemon/config/numbers.h"
#include "daemon/config/values.h"
#include "sim/text/quote.h"

namespace scipd::daemon {
namespace {

namespace fs = std::filesystem;

using sim::Expected;
using sim::quote;
using sim::refuse;

/// What a topic of VDA 5050 may hold.
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

/// What a name of a topic may be, by the design of ROS ("Topic and Service Names").
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
