// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/bridges/ros_json.h"

#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>

#include <nlohmann/json.hpp>

#include "daemon/bridges/checked_pose.h"
#include "sim/loaders/poses/small_json.h"

namespace scipd::daemon {
namespace {

using Json = nlohmann::json;

// A message of all frames of a robot has some thousands.
constexpr int most_values = 200'000;

const Json nothing = Json::object();

const Json& member(const Json& object, const char* key) {
    const auto found = object.find(key);
    return found == object.end() || !found->is_object() ? nothing : *found;
}

std::string text_in(const Json& object, const char* key) {
    const auto found = object.find(key);
    return found == object.end() || !found->is_string() ? std::string() : found->get<std::string>();
}

/// rosbridge writes null for what JSON has no word for: what is not a number, or infinite.
double number_in(const Json& object, const char* key) {
    const auto found = object.find(key);
    const bool is_number = found != object.end() && found->is_number();
    return is_number ? found->get<double>() : std::numeric_limits<double>::quiet_NaN();
}

std::array<double, 3> three_in(const Json& object) {
    return {number_in(object, "x"), number_in(object, "y"), number_in(object, "z")};
}

/// {sec, nanosec} of ROS 2, {secs, nsecs} of ROS 1. Zero stands for no time.
std::optional<sim::Time> time_in(const Json& stamp) {
    const bool ros1 = stamp.contains("secs");
    const double whole_s = number_in(stamp, ros1 ? "secs" : "sec");
    const double rest_ns = number_in(stamp, ros1 ? "nsecs" : "nanosec");
    if (!(std::abs(whole_s) <= 9e9) || !(rest_ns >= 0.0 && rest_ns < 1e10)) return std::nullopt;
    if (whole_s == 0.0 && rest_ns == 0.0) return std::nullopt;
    return std::chrono::seconds(std::llround(whole_s)) + sim::Time(std::llround(rest_ns));
}

/// A pose has position and orientation, a transform translation and rotation.
sim::Expected<HeardPose> stamped_pose(const Json& message, const Json& pose) {
    const bool transform = pose.contains("translation");
    const Json& q = member(pose, transform ? "rotation" : "orientation");
    const auto [x, y, z] = three_in(q);
    return checked_pose("pose", three_in(member(pose, transform ? "translation" : "position")),
                        {x, y, z, number_in(q, "w")})
        .map([&](const sim::Pose& checked) {
            const Json& header = member(message, "header");
            return HeardPose{.parent = text_in(header, "frame_id"),
                             .child = text_in(message, "child_frame_id"),
                             .time = time_in(member(header, "stamp")),
                             .parent_from_child = checked};
        });
}

sim::Expected<> add_pose(const Json& message, const Json& pose, Heard& heard) {
    return stamped_pose(message, pose).map([&](const HeardPose& read) {
        heard.poses.push_back(read);
    });
}

sim::Expected<> read_odometry(const Json& message, Heard& heard) {
    heard.type = "nav_msgs/Odometry";
    return add_pose(message, member(member(message, "pose"), "pose"), heard).map([&] {
        HeardPose& pose = heard.poses.front();
        const Json& twist = member(member(message, "twist"), "twist");
        const auto linear = three_in(member(twist, "linear"));
        const auto angular = three_in(member(twist, "angular"));
        pose.velocity = velocity_in_parent(pose.parent_from_child.rotation, linear, angular);
    });
}

sim::Expected<> read_transforms(const Json& transforms, Heard& heard) {
    heard.type = "tf2_msgs/TFMessage";
    for (const Json& transform : transforms) {
        if (!transform.is_object()) return sim::refuse("a transform must be an object");
        if (auto read = add_pose(transform, member(transform, "transform"), heard); !read)
            return read;
    }
    return {};
}

/// By what it has, the message is of one type.
sim::Expected<> read_message(const Json& message, Heard& heard) {
    const auto transforms = message.find("transforms");
    if (transforms != message.end() && transforms->is_array())
        return read_transforms(*transforms, heard);
    if (message.contains("twist")) return read_odometry(message, heard);
    if (message.contains("transform")) {
        heard.type = "geometry_msgs/TransformStamped";
        return add_pose(message, member(message, "transform"), heard);
    }
    const Json& pose = member(message, "pose");
    if (pose.contains("pose")) {
        heard.type = "geometry_msgs/PoseWithCovarianceStamped";
        return add_pose(message, member(pose, "pose"), heard);
    }
    if (message.contains("pose")) {
        heard.type = "geometry_msgs/PoseStamped";
        return add_pose(message, pose, heard);
    }
    if (message.contains("clock")) {
        heard.type = "rosgraph_msgs/Clock";
        heard.clock = time_in(member(message, "clock")).value_or(sim::Time{});
        return {};
    }
    return sim::refuse("it holds no pose that scipd can read");
}

}  // namespace

sim::Expected<RosbridgeMessage> read_rosbridge(std::string_view text) {
    const auto said = sim::parse_small_json(text, most_values);
    if (!said) return tl::unexpected(said.error());
    if (!said->is_object()) return sim::refuse("must be a JSON object");
    const std::string op = text_in(*said, "op");
    if (op == "status" && text_in(*said, "level") == "error")
        return RosbridgeRefusal{text_in(*said, "id"), text_in(*said, "msg")};
    if (op != "publish") return RosbridgeOther{};
    RosbridgePublish published{.topic = text_in(*said, "topic"), .heard = {}};
    const auto read = read_message(member(*said, "msg"), published.heard);
    if (!read) return sim::refuse(published.topic + ": " + read.error().why);
    return published;
}

std::string subscription_to(const std::string& topic) {
    return Json{{"op", "subscribe"}, {"id", topic}, {"topic", topic}}.dump();
}

}  // namespace scipd::daemon
