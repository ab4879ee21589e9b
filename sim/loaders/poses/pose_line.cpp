// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// parse_pose_line() of trajectory.h: the JSON form here, the TUM form in tum_line.
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "sim/loaders/poses/small_json.h"
#include "sim/loaders/poses/trajectory.h"
#include "sim/loaders/poses/tum_line.h"
#include "sim/text/quote.h"
#include "sim/text/text_number.h"
#include "sim/world/reach.h"

namespace scipd::sim {
namespace {

using Json = nlohmann::json;

/// Why a line is refused; empty where all is well.
using Refusal = std::string;

constexpr std::size_t longest_line = 4096;
constexpr double angle_limit_rad = 1e6;
constexpr std::array known_keys{"robot", "model", "t", "xyz", "q", "rpy", "v", "w"};
constexpr double fastest = 1e6;  // m/s, rad/s

Refusal check_keys(const Json& object) {
    for (const auto& [key, value] : object.items()) {
        if (std::find(known_keys.begin(), known_keys.end(), key) == known_keys.end()) {
            return "the key " + quote(key) +
                   " is unknown; known are robot, model, t, xyz, q, rpy, v, w";
        }
    }
    if (object.contains("robot") && object.contains("model")) {
        return "robot and model exclude each other";
    }
    if (object.contains("q") && object.contains("rpy")) return "q and rpy exclude each other";
    if (!object.contains("xyz")) return "xyz is missing";
    return {};
}

Refusal read_name(const Json& object, const char* key, std::string& name) {
    const auto field = object.find(key);
    if (field == object.end()) return {};
    if (!field->is_string() || field->get_ref<const std::string&>().empty()) {
        return std::string{key} + " must be a name between double quotes";
    }
    name = field->get<std::string>();
    return {};
}

template <std::size_t Count>
Refusal read_numbers(const Json& field, const char* key, std::array<double, Count>& numbers) {
    const bool fits = field.is_array() && field.size() == Count &&
                      std::all_of(field.begin(), field.end(),
                                  [](const Json& number) { return number.is_number(); });
    if (!fits) {
        return std::string{key} + " must be an array of " + std::to_string(Count) + " numbers";
    }
    std::transform(field.begin(), field.end(), numbers.begin(),
                   [](const Json& number) { return number.get<double>(); });
    return {};
}

Refusal read_time(const Json& object, std::optional<Time>& time) {
    const auto field = object.find("t");
    if (field == object.end()) return {};
    if (!field->is_number()) return "t must be a number of seconds";
    const auto t_s = field->get<double>();
    if (!(std::abs(t_s) <= time_limit_s)) return "t must lie within 9e9 s of zero";
    // Whole seconds apart from the rest: their product with 1e9 would lose what the double still
    // has.
    const double whole_s = std::floor(t_s);
    time = std::chrono::seconds{std::llround(whole_s)} + Time{std::llround((t_s - whole_s) * 1e9)};
    return {};
}

Refusal read_position(const Json& object, Pose& pose) {
    std::array<double, 3> xyz_m{};
    if (auto refusal = read_numbers(object["xyz"], "xyz", xyz_m); !refusal.empty()) return refusal;
    pose.translation_m = {xyz_m[0], xyz_m[1], xyz_m[2]};
    if (!plausible_position(pose.translation_m)) return "xyz must lie within 1e7 m of the origin";
    return {};
}

Refusal read_rotation(const Json& object, Pose& pose) {
    if (object.contains("q")) {
        std::array<double, 4> q{};
        if (auto refusal = read_numbers(object["q"], "q", q); !refusal.empty()) return refusal;
        const auto rotation = normalised_quaternion(q[0], q[1], q[2], q[3]);
        if (!rotation) return "q must be a quaternion x, y, z, w of length 1";
        pose.rotation = *rotation;
    } else if (object.contains("rpy")) {
        std::array<double, 3> rpy_rad{};
        if (auto refusal = read_numbers(object["rpy"], "rpy", rpy_rad); !refusal.empty()) {
            return refusal;
        }
        for (const double angle_rad : rpy_rad) {
            if (!(std::abs(angle_rad) <= angle_limit_rad)) return "rpy must lie within 1e6 rad";
        }
        pose = pose_from_rpy(pose.translation_m, {rpy_rad[0], rpy_rad[1], rpy_rad[2]});
    }
    return {};
}

Refusal read_rate(const Json& object, const char* key, glm::dvec3& rate) {
    std::array<double, 3> numbers{};
    if (auto refusal = read_numbers(object[key], key, numbers); !refusal.empty()) return refusal;
    for (const double number : numbers) {
        if (!(std::abs(number) <= fastest)) return std::string{key} + " must lie within 1e6";
    }
    rate = {numbers[0], numbers[1], numbers[2]};
    return {};
}

/// v and w: each is zero where only the other is there.
Refusal read_velocity(const Json& object, std::optional<Velocity>& velocity) {
    Refusal refusal;
    Velocity said;
    if (object.contains("v")) refusal = read_rate(object, "v", said.linear_mps);
    if (refusal.empty() && object.contains("w"))
        refusal = read_rate(object, "w", said.angular_radps);
    if (object.contains("v") || object.contains("w")) velocity = said;
    return refusal;
}

std::variant<PoseLine, std::string> parse_json_line(std::string_view line) {
    Json object;
    try {
        object = parse_small_json(line);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    PoseLine said;
    auto refusal = check_keys(object);
    if (refusal.empty()) refusal = read_name(object, "robot", said.robot);
    if (refusal.empty()) refusal = read_name(object, "model", said.model);
    if (refusal.empty()) refusal = read_time(object, said.time);
    if (refusal.empty()) refusal = read_position(object, said.pose);
    if (refusal.empty()) refusal = read_rotation(object, said.pose);
    if (refusal.empty()) refusal = read_velocity(object, said.velocity);
    if (!refusal.empty()) return refusal;
    return said;
}

}  // namespace

std::variant<PoseLine, std::string> parse_pose_line(std::string_view line) {
    if (line.size() > longest_line) return "the line is longer than 4096 bytes";
    line = trimmed(line);
    if (says_nothing(line)) return "the line holds no pose";
    if (line.front() == '{') return parse_json_line(line);
    auto parsed = parse_tum_line(line);
    if (auto* refusal = std::get_if<std::string>(&parsed)) return std::move(*refusal);
    const auto& [time, pose] = std::get<TimedPose>(parsed);
    return PoseLine{.robot = {}, .model = {}, .time = time, .pose = pose, .velocity = {}};
}

}  // namespace scipd::sim
