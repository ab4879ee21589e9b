// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/fleet/vda5050.h"

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>

#include <nlohmann/json.hpp>

#include "sim/loaders/poses/small_json.h"
#include "sim/world/pose.h"
#include "sim/world/reach.h"

namespace scipd::daemon {
namespace {

using Json = nlohmann::json;

// A state lists all nodes and edges that the vehicle still has before it.
constexpr int most_values = 50'000;
constexpr double largest_angle_rad = 1e6;

/// Nothing where there is no such number.
std::optional<double> number_in(const Json& object, const char* key) {
    const auto found = object.find(key);
    if (found == object.end() || !found->is_number()) return std::nullopt;
    return found->get<double>();
}

/// "2025-01-31T12:34:56.78Z" as a time since 1970.
std::optional<sim::Time> time_in(const Json& state) {
    const auto found = state.find("timestamp");
    if (found == state.end() || !found->is_string()) return std::nullopt;
    int year = 0;
    unsigned month = 0;
    unsigned day = 0;
    int hour = 0;
    int minute = 0;
    double second = 0.0;
    const int read =
        std::sscanf(found->get_ref<const std::string&>().c_str(), "%4d-%2u-%2uT%2d:%2d:%9lf", &year,
                    &month, &day, &hour, &minute, &second);
    using namespace std::chrono;
    const year_month_day date{std::chrono::year(year), std::chrono::month(month),
                              std::chrono::day(day)};
    // Beyond these years nanoseconds since 1970 do not fit.
    if (read != 6 || !date.ok() || year < 1700 || year > 2250 || !(std::abs(second) <= 61.0))
        return std::nullopt;
    return sim::Time(sys_days(date).time_since_epoch()) + hours(hour) + minutes(minute) +
           sim::Time(std::llround(second * 1e9));
}

/// As the vehicle sees it: forwards, to the left, and turning.
std::optional<sim::Velocity> velocity_in(const Json& state, const glm::dquat& rotation) {
    const auto found = state.find("velocity");
    if (found == state.end() || !found->is_object()) return std::nullopt;
    const glm::dvec3 in_robot_mps{number_in(*found, "vx").value_or(0.0),
                                  number_in(*found, "vy").value_or(0.0), 0.0};
    const double omega_radps = number_in(*found, "omega").value_or(0.0);
    constexpr double most = 1e6;
    for (const double value : {in_robot_mps.x, in_robot_mps.y, omega_radps}) {
        if (!(std::abs(value) <= most)) return std::nullopt;
    }
    return sim::Velocity{rotation * in_robot_mps, {0.0, 0.0, omega_radps}};
}

}  // namespace

std::string vda5050_topic(const std::string& vehicle, const std::string& robot) {
    const bool whole = vehicle.find('/') != vehicle.npos;
    return "uagv/v2/" + vehicle + (whole ? "" : "/" + robot) + "/state";
}

sim::Expected<sim::PoseLine> parse_vda5050_state(std::string_view text) {
    const auto state = sim::parse_small_json(text, most_values);
    if (!state) return tl::unexpected(state.error());
    if (!state->is_object()) return sim::refuse("the state must be a JSON object");
    const auto position = state->find("agvPosition");
    if (position == state->end() || !position->is_object())
        return sim::refuse("agvPosition", "agvPosition is missing");
    const auto initialized = position->find("positionInitialized");
    if (initialized != position->end() && *initialized == false)
        return sim::refuse("agvPosition", "the vehicle does not know where it is");
    const auto x_m = number_in(*position, "x");
    const auto y_m = number_in(*position, "y");
    const auto theta_rad = number_in(*position, "theta");
    if (!x_m || !y_m || !theta_rad)
        return sim::refuse("agvPosition", "agvPosition must have the numbers x, y and theta");
    const glm::dvec3 xyz_m{*x_m, *y_m, 0.0};
    if (!sim::plausible_position(xyz_m) || !(std::abs(*theta_rad) <= largest_angle_rad))
        return sim::refuse("agvPosition", "agvPosition must lie within 1e7 m of the origin");
    sim::PoseLine line{.time = time_in(*state),
                       .pose = sim::pose_from_rpy(xyz_m, {0.0, 0.0, *theta_rad})};
    line.velocity = velocity_in(*state, line.pose.rotation);
    return line;
}

}  // namespace scipd::daemon
