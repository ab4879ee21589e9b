// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The JSON form of a pose line is read here, the TUM form in tum_line.
#include "sim/loaders/poses/pose_line.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include <glm/geometric.hpp>

#include "sim/loaders/poses/small_json.h"
#include "sim/text/quote.h"
#include "sim/text/text_number.h"
#include "sim/world/reach.h"

namespace scipd::sim {
namespace {

using Json = nlohmann::json;

constexpr std::size_t longest_line = 4096;
constexpr double angle_limit_rad = 1e6;
constexpr std::array known_keys{"robot", "model", "t", "xyz", "q", "rpy", "v", "w"};
constexpr double fastest = 1e6;  // m/s, rad/s

Expected<> check_keys(const Json& object) {
    for (const auto& [key, value] : object.items()) {
        if (std::find(known_keys.begin(), known_keys.end(), key) == known_keys.end()) {
            return refuse(printable(key, 40),
                          "the key " + quote(key) +
                              " is unknown; known are robot, model, t, xyz, q, rpy, v, w");
        }
    }
    if (object.contains("robot") && object.contains("model")) {
        return refuse("robot", "robot and model exclude each other");
    }
    if (object.contains("q") && object.contains("rpy"))
        return refuse("q", "q and rpy exclude each other");
    if (!object.contains("xyz")) return refuse("xyz", "xyz is missing");
    return {};
}

Expected<> read_name(const Json& object, const char* key, std::string& name) {
    const auto field = object.find(key);
    if (field == object.end()) return {};
    if (!field->is_string() || field->get_ref<const std::string&>().empty()) {
        return refuse(key, std::string{key} + " must be a name between double quotes");
    }
    name = field->get<std::string>();
    return {};
}

template <std::size_t Count>
Expected<> read_numbers(const Json& field, const char* key, std::array<double, Count>& numbers) {
    const bool fits = field.is_array() && field.size() == Count &&
                      std::all_of(field.begin(), field.end(),
                                  [](const Json& number) { return number.is_number(); });
    if (!fits) {
        return refuse(
            key, std::string{key} + " must be an array of " + std::to_string(Count) + " numbers");
    }
    std::transform(field.begin(), field.end(), numbers.begin(),
                   [](const Json& number) { return number.get<double>(); });
    return {};
}

Expected<> read_time(const Json& object, std::optional<Time>& time) {
    const auto field = object.find("t");
    if (field == object.end()) return {};
    if (!field->is_number()) return refuse("t", "t must be a number of seconds");
    const auto t_s = field->get<double>();
    if (!(std::abs(t_s) <= time_limit_s)) return refuse("t", "t must lie within 9e9 s of zero");
    // Whole seconds and the rest are converted apart from each other: t_s * 1e9 would lose digits
    // that the double still has.
    const double whole_s = std::floor(t_s);
    time = std::chrono::seconds{std::llround(whole_s)} + Time{std::llround((t_s - whole_s) * 1e9)};
    return {};
}

Expected<> read_position(const Json& object, Pose& pose) {
    std::array<double, 3> xyz_m{};
    if (auto read = read_numbers(object["xyz"], "xyz", xyz_m); !read) return read;
    pose.translation_m = {xyz_m[0], xyz_m[1], xyz_m[2]};
    if (!plausible_position(pose.translation_m))
        return refuse("xyz", "xyz must lie within 1e7 m of the origin");
    return {};
}

Expected<> read_quaternion(const Json& field, Pose& pose) {
    std::array<double, 4> q{};
    if (auto read = read_numbers(field, "q", q); !read) return read;
    const auto rotation = normalised_quaternion(q[0], q[1], q[2], q[3]);
    if (!rotation) return refuse("q", "q must be a quaternion x, y, z, w of length 1");
    pose.rotation = *rotation;
    return {};
}

Expected<> read_angles(const Json& field, Pose& pose) {
    std::array<double, 3> rpy_rad{};
    if (auto read = read_numbers(field, "rpy", rpy_rad); !read) return read;
    for (const double angle_rad : rpy_rad) {
        if (!(std::abs(angle_rad) <= angle_limit_rad))
            return refuse("rpy", "rpy must lie within 1e6 rad");
    }
    pose = pose_from_rpy(pose.translation_m, {rpy_rad[0], rpy_rad[1], rpy_rad[2]});
    return {};
}

Expected<> read_rotation(const Json& object, Pose& pose) {
    if (object.contains("q")) return read_quaternion(object["q"], pose);
    if (object.contains("rpy")) return read_angles(object["rpy"], pose);
    return {};
}

Expected<> read_rate(const Json& object, const char* key, glm::dvec3& rate) {
    if (!object.contains(key)) return {};
    std::array<double, 3> numbers{};
    if (auto read = read_numbers(object[key], key, numbers); !read) return read;
    for (const double number : numbers) {
        if (!(std::abs(number) <= fastest))
            return refuse(key, std::string{key} + " must lie within 1e6");
    }
    rate = {numbers[0], numbers[1], numbers[2]};
    return {};
}

/// v and w: each is zero where only the other is there.
Expected<> read_velocity(const Json& object, std::optional<Velocity>& velocity) {
    if (!object.contains("v") && !object.contains("w")) return {};
    velocity.emplace();
    return read_rate(object, "v", velocity->linear_mps).and_then([&] {
        return read_rate(object, "w", velocity->angular_radps);
    });
}

constexpr std::array tum_columns{"t", "tx", "ty", "tz", "qx", "qy", "qz", "qw"};
constexpr std::string_view blanks = " \t\r\n\v\f";

/// The columns of a line, cut at blanks. Those after the eighth are counted, but not kept.
struct Columns {
    std::array<std::string_view, tum_columns.size()> text;
    std::size_t count = 0;

    explicit Columns(std::string_view line) {
        while (!(line = trimmed(line)).empty()) {
            const auto end = std::min(line.find_first_of(blanks), line.size());
            if (count < text.size()) text[count] = line.substr(0, end);
            ++count;
            line.remove_prefix(end);
        }
    }
};

}  // namespace

bool says_nothing(std::string_view line) {
    const auto text = trimmed(line);
    return text.empty() || text.front() == '#';
}

Expected<PoseLine> pose_line_in(const Json& object) {
    PoseLine said;
    return check_keys(object)
        .and_then([&] { return read_name(object, "robot", said.robot); })
        .and_then([&] { return read_name(object, "model", said.model); })
        .and_then([&] { return read_time(object, said.time); })
        .and_then([&] { return read_position(object, said.pose); })
        .and_then([&] { return read_rotation(object, said.pose); })
        .and_then([&] { return read_velocity(object, said.velocity); })
        .map([&] { return std::move(said); });
}

Expected<PoseLine> parse_pose_line(std::string_view line) {
    if (line.size() > longest_line) return refuse("the line is longer than 4096 bytes");
    line = trimmed(line);
    if (says_nothing(line)) return refuse("the line holds no pose");
    if (line.front() == '{') return parse_small_json(line).and_then(pose_line_in);
    return parse_tum_line(line).map([](const TimedPose& said) {
        return PoseLine{
            .robot = {}, .model = {}, .time = said.time, .pose = said.pose, .velocity = {}};
    });
}

std::optional<glm::dquat> normalised_quaternion(double x, double y, double z, double w) {
    const double length = std::sqrt(x * x + y * y + z * z + w * w);
    if (!(length >= 1e-6 && length <= 1e6)) return {};
    return glm::dquat{w / length, x / length, y / length, z / length};
}

Expected<glm::dquat> quaternion_in_file(const glm::dvec4& xyzw, const std::string& columns) {
    constexpr double tolerance = 0.02;
    const double length = glm::length(xyzw);
    if (std::abs(length - 1.0) <= tolerance)
        return glm::dquat{xyzw.w, xyzw.x, xyzw.y, xyzw.z} / length;
    std::array<char, 32> figure{};
    std::snprintf(figure.data(), figure.size(), "%.4g", length);
    return refuse(columns + " must be a quaternion of length 1, not " + figure.data() +
                  "; divide each by that, or see whether the columns are these");
}

Expected<TimedPose> parse_tum_line(std::string_view line) {
    const Columns columns{line};
    if (columns.count != tum_columns.size()) {
        return refuse("a pose has 8 columns (t tx ty tz qx qy qz qw), this line has " +
                      std::to_string(columns.count));
    }
    const auto time = parse_stamp(columns.text[0]);
    if (!time) {
        return refuse("t",
                      "t must be seconds as decimals below 9e9, not " + quote(columns.text[0]));
    }
    std::array<double, tum_columns.size()> value{};
    for (std::size_t i = 1; i < value.size(); ++i) {
        const auto number = parse_number(columns.text[i]);
        if (!number) {
            return refuse(std::string{tum_columns[i]} + " must be a finite number, not " +
                          quote(columns.text[i]));
        }
        value[i] = *number;
    }
    const glm::dvec3 xyz_m{value[1], value[2], value[3]};
    if (!plausible_position(xyz_m)) return refuse("tx ty tz must lie within 1e7 m of the origin");
    const auto rotation =
        quaternion_in_file({value[4], value[5], value[6], value[7]}, "qx qy qz qw");
    if (!rotation) return tl::unexpected(rotation.error());
    return TimedPose{*time, {xyz_m, *rotation}};
}

}  // namespace scipd::sim
