// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/models/best_fit.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>

#include "daemon/models/model_registry.h"
#include "daemon/models/product_lines.h"
#include "daemon/models/profile_check.h"

namespace scipd::daemon {
namespace {

constexpr double deg_per_rad = 180.0 / std::numbers::pi;

/// A product, described as a world describes a lidar.
sim::Lidar figures_of(const Model& model) {
    constexpr double m_per_mm = 1e-3;
    const sim::SensorSpec& optics = model.optics;
    const std::chrono::duration<double> period = model.profile.nominal_scan_period();
    return {.samples = optics.beams(),
            .rows = 1,
            .min_angle_rad = optics.angle_rad(optics.first_step),
            .max_angle_rad = optics.angle_rad(optics.last_step),
            .min_range_m = model.profile.dmin_mm * m_per_mm,
            .max_range_m = optics.max_range_m,
            .rate_hz = 1.0 / period.count()};
}

double view_rad(const sim::Lidar& lidar) {
    return lidar.max_angle_rad - lidar.min_angle_rad;
}

/// 0 if a row has only one beam.
double step_rad(const sim::Lidar& lidar) {
    return lidar.samples < 2 ? 0.0 : view_rad(lidar) / (lidar.samples - 1);
}

/// How far apart two figures are, in factors of e, in either direction; 0 if one of them is
/// unknown.
double apart(double a, double b) {
    const bool known = a > 0.0 && b > 0.0 && std::isfinite(a) && std::isfinite(b);
    return known ? std::abs(std::log(a / b)) : 0.0;
}

/// A program may leave beams out, but cannot look where there are none: a view that is too narrow
/// is worse than a scan at twice the rate.
double view_apart(double has_rad, double wanted_rad) {
    constexpr double weight_of_lack = 4.0;
    return apart(has_rad, wanted_rad) * (has_rad < wanted_rad ? weight_of_lack : 1.0);
}

/// Hokuyo puts this range into the product's name: a UST-10LX has 10 m. It is mostly far below
/// DMAX. 0 if the name has none.
double guaranteed_range_m(const std::string& product) {
    constexpr int decimal = 10;
    const auto dash = product.find('-');
    if (dash == product.npos) return 0.0;
    return static_cast<double>(std::strtol(product.c_str() + dash + 1, nullptr, decimal));
}

/// A world may have the range of the data sheet or the one that the product reports.
double range_apart(const Model& model, const sim::Lidar& lidar) {
    const double reported = apart(model.optics.max_range_m, lidar.max_range_m);
    const double guaranteed_m = guaranteed_range_m(model.profile.name);
    if (guaranteed_m <= 0.0) return reported;
    return std::min(reported, apart(guaranteed_m, lidar.max_range_m));
}

bool same(double a, double b) {
    constexpr double rounded = 0.01;
    return a == b || std::abs(a - b) <= rounded * std::max(std::abs(a), std::abs(b));
}

std::string span(double low, double high, const char* unit) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.3g to %.4g %s", low, high, unit);
    return text.data();
}

std::string one(double value, const char* unit) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.10g%s", std::round(value * 100) / 100, unit);
    return text.data();
}

std::string range_text(const sim::Lidar& lidar) {
    return span(lidar.min_range_m, lidar.max_range_m, "m");
}

std::string angle_text(const sim::Lidar& lidar) {
    return span(lidar.min_angle_rad * deg_per_rad, lidar.max_angle_rad * deg_per_rad, "deg");
}

/// Returns true if the product has beams in all directions of the lidar, modulo a turn.
bool has_directions(const sim::Lidar& has, const sim::Lidar& lidar) {
    constexpr double turn_rad = 2.0 * std::numbers::pi;
    const double slack_rad = 0.75 * std::max(step_rad(has), std::abs(step_rad(lidar)));
    const double middle_rad =
        std::remainder((lidar.min_angle_rad + lidar.max_angle_rad) / 2.0, turn_rad);
    const double half_rad = std::abs(view_rad(lidar)) / 2.0;
    return middle_rad - half_rad > has.min_angle_rad - slack_rad &&
           middle_rad + half_rad < has.max_angle_rad + slack_rad;
}

/// Returns true if a step of the lidar is one or several of the product.
bool has_steps(const sim::Lidar& has, const sim::Lidar& lidar) {
    constexpr double same_ratio = 0.02;
    const double ratio = std::abs(step_rad(lidar)) / step_rad(has);
    return ratio > 1.0 - same_ratio && std::abs(ratio - std::round(ratio)) < same_ratio;
}

bool has_range(const sim::Lidar& has, const sim::Lidar& lidar) {
    constexpr double rounded = 1.001;
    return !std::isfinite(lidar.max_range_m) || lidar.max_range_m <= has.max_range_m * rounded;
}

/// A whole turn, unless the lidar's directions are those of steps in the order of SCIP.
void put_steps(const sim::Lidar& lidar, protocol::DeviceProfile& profile) {
    const double step = std::abs(step_rad(lidar));
    profile.ares = static_cast<int>(std::lround(2.0 * std::numbers::pi / step));
    profile.afrt = profile.ares / 2;
    const double middle_rad =
        std::remainder((lidar.min_angle_rad + lidar.max_angle_rad) / 2.0, 2.0 * std::numbers::pi);
    const double from_front = middle_rad / step - (lidar.samples - 1) / 2.0;
    profile.amin = profile.afrt + static_cast<int>(std::lround(from_front));
    profile.amax = profile.amin + lidar.samples - 1;
    if (profile.amin < 0 || profile.amax >= profile.ares) {
        profile.amin = 0;
        profile.amax = profile.ares - 1;
    }
    profile.first_step = profile.amin;
    profile.last_step = profile.amax;
}

void put_range(const sim::Lidar& lidar, protocol::DeviceProfile& profile) {
    constexpr double mm_per_m = 1000.0;
    constexpr int nearest_mm = 20;  // below are codes of SCIP
    constexpr double farthest_mm = (1U << 18U) - 1;
    profile.dmin_mm = std::max(nearest_mm, static_cast<int>(lidar.min_range_m * mm_per_m));
    profile.nearest_mm = profile.dmin_mm;
    if (std::isfinite(lidar.max_range_m) && lidar.max_range_m > 0.0)
        profile.dmax_mm =
            static_cast<int>(std::lround(std::min(lidar.max_range_m * mm_per_m, farthest_mm)));
    if (profile.is_distance(profile.codes.nothing)) profile.codes = utm_codes();
}

void put_rate(const sim::Lidar& lidar, protocol::DeviceProfile& profile) {
    constexpr double slowest_hz = 0.1;
    constexpr double fastest_hz = 1000.0;
    if (!(lidar.rate_hz > 0.0)) return;
    const double rate_hz = std::clamp(lidar.rate_hz, slowest_hz, fastest_hz);
    profile.scan_rpm = static_cast<int>(std::lround(60.0 * rate_hz));
    profile.scan_period =
        std::chrono::round<protocol::Uptime>(std::chrono::duration<double>(1.0 / rate_hz));
}

}  // namespace

double misfit(const Model& model, const sim::Lidar& lidar) {
    constexpr double weight_of_range = 2.0;
    constexpr double weight_of_nearest = 0.1;
    constexpr double weight_of_rate = 0.8;
    const sim::Lidar has = figures_of(model);
    return weight_of_range * range_apart(model, lidar) +
           weight_of_nearest * apart(has.min_range_m, lidar.min_range_m) +
           view_apart(view_rad(has), view_rad(lidar)) + apart(step_rad(has), step_rad(lidar)) +
           weight_of_rate * apart(has.rate_hz, lidar.rate_hz);
}

const Model& best_fit(const sim::Lidar& lidar) {
    return *std::ranges::min_element(models(), {},
                                     [&](const Model& model) { return misfit(model, lidar); });
}

const Model* model_named_in(const std::string& text, const std::string& firmware) {
    const Model* found = nullptr;
    std::size_t longest = 0;
    for (const Model& model : models()) {
        const std::string name = model.profile.name.substr(0, model.profile.name.find('@'));
        const bool whole = text == model.profile.model;
        const std::size_t length = whole                          ? text.size()
                                   : text.find(name) != text.npos ? name.size()
                                                                  : 0;
        const bool same_firmware = length == longest && model.profile.firmware == firmware;
        if (length == 0 || (length <= longest && !same_firmware)) continue;
        found = &model;
        longest = length;
    }
    return found;
}

sim::Lidar recorded_lidar(const sim::Directions& directions, std::size_t steps,
                          const sim::ScannerIdentity& identity, double rate_hz) {
    const double first_rad = directions.first_rad.value_or(0.0);
    const double last_rad =
        first_rad + directions.increment_rad.value_or(0.0) * (static_cast<double>(steps) - 1.0);
    return {.samples = static_cast<int>(steps),
            .min_angle_rad = std::min(first_rad, last_rad),
            .max_angle_rad = std::max(first_rad, last_rad),
            .min_range_m = identity.min_range_m.value_or(0.0),
            .max_range_m = identity.max_range_m.value_or(0.0),
            .rate_hz = rate_hz};
}

std::string missing_in_best_fit(const sim::Lidar& lidar) {
    if (lidar.samples < 2 || !(std::abs(step_rad(lidar)) > 0.0)) return {};
    const sim::Lidar has = figures_of(best_fit(lidar));
    std::string text;
    const auto add = [&](const std::string& is, const std::string& wanted) {
        text += (text.empty() ? "" : ", ") + is + " instead of " + wanted;
    };
    if (!has_directions(has, lidar)) add(angle_text(has), angle_text(lidar));
    if (!has_steps(has, lidar))
        add("steps of " + one(step_rad(has) * deg_per_rad, " deg"),
            one(step_rad(lidar) * deg_per_rad, " deg"));
    if (!has_range(has, lidar)) add(range_text(has), range_text(lidar));
    return text;
}

namespace {

/// SCIP numbers steps with four digits: of finer ones every second, third and so on is kept.
sim::Lidar with_steps_of_scip(sim::Lidar lidar) {
    constexpr double most_of_a_turn = 9999.0;
    const double step = std::abs(step_rad(lidar));
    if (lidar.samples < 2 || !(step > 0.0)) return lidar;
    const auto factor = static_cast<int>(std::ceil(2.0 * std::numbers::pi / step / most_of_a_turn));
    if (factor < 2) return lidar;
    lidar.samples = (lidar.samples - 1) / factor + 1;
    lidar.max_angle_rad = lidar.min_angle_rad + (lidar.samples - 1) * step * factor;
    return lidar;
}

}  // namespace

Model recorded_model(const sim::Lidar& recorded) {
    const sim::Lidar lidar = with_steps_of_scip(recorded);
    const Model& like = best_fit(lidar);
    if (missing_in_best_fit(lidar).empty()) return like;
    protocol::DeviceProfile profile = like.profile;
    profile.name = "recorded";
    profile.model = "recorded";
    put_steps(lidar, profile);
    put_range(lidar, profile);
    put_rate(lidar, profile);
    return faults_of(profile).empty() ? make_model(profile, like.optics, like.sureness) : like;
}

std::string differences(const Model& model, const sim::Lidar& lidar) {
    const sim::Lidar has = figures_of(model);
    std::string text;
    const auto add = [&](const std::string& is, const std::string& wanted) {
        text += (text.empty() ? "" : ", ") + is + " instead of " + wanted;
    };
    constexpr double same_angle_rad = 0.01;
    if (!same(has.min_range_m, lidar.min_range_m) || !same(has.max_range_m, lidar.max_range_m))
        add(range_text(has), range_text(lidar));
    if (std::abs(has.min_angle_rad - lidar.min_angle_rad) > same_angle_rad ||
        std::abs(has.max_angle_rad - lidar.max_angle_rad) > same_angle_rad)
        add(angle_text(has), angle_text(lidar));
    if (has.samples != lidar.samples)
        add(std::to_string(has.samples) + " steps", std::to_string(lidar.samples));
    if (lidar.rate_hz > 0.0 && !same(has.rate_hz, lidar.rate_hz))
        add(one(has.rate_hz, " Hz"), one(lidar.rate_hz, " Hz"));
    if (lidar.rows > 1) add("one row", std::to_string(lidar.rows));
    return text;
}

}  // namespace scipd::daemon
