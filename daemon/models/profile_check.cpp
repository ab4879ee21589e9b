// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/models/profile_check.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "protocol/command_table.h"

namespace scipd::daemon {
namespace {

using protocol::DeviceProfile;
using protocol::Feature;
using protocol::Support;

constexpr int largest_step = 9999;      // four digits of GD
constexpr int largest_value = 0x3FFFF;  // three characters of six bits
constexpr int fastest_turn_ms = 1;
constexpr int slowest_turn_ms = 10'000;
constexpr int most_turns_per_reply = 100;
constexpr double most_turn_error = 0.05;  // of the real period against the nominal speed

/// Whether some model of the family carries out the command.
bool family_can(protocol::Family family, std::string_view code) {
    return std::ranges::any_of(protocol::command_table(), [&](const protocol::Command& command) {
        const protocol::Gate& gate = command.gate(family);
        return command.code == code && gate.known() && !gate.refusal(protocol::State::standby);
    });
}

bool family_can(protocol::Family family, Feature feature) {
    return std::ranges::any_of(protocol::command_table(), [&](const protocol::Command& command) {
        return command.needs == feature && command.gate(family).known();
    });
}

class Check {
  public:
    explicit Check(const DeviceProfile& profile) : profile_(profile) {}

    std::vector<ProfileFault> faults() && {
        distances();
        steps();
        speed();
        codes();
        rare_codes();
        abilities();
        bit_rates();
        return std::move(faults_);
    }

  private:
    void add(std::string_view member, std::string sentence) {
        faults_.push_back({member, std::move(sentence)});
    }

    void at_least(std::string_view member, int value, int limit) {
        if (value < limit) add(member, "must be at least " + std::to_string(limit));
    }

    /// `what` says what the limit is. A limit is negative only because of another fault, which is
    /// reported already.
    void at_most(std::string_view member, int value, int limit, const std::string& what) {
        if (value <= limit || limit < 0) return;
        add(member,
            "must be at most " + std::to_string(limit) + what + ", not " + std::to_string(value));
    }

    void distances();
    void steps();
    void speed();
    void codes();
    void code(std::string_view member, std::string_view name, std::uint32_t code);
    void rare_codes();
    void abilities();
    void bit_rates();

    const DeviceProfile& profile_;
    std::vector<ProfileFault> faults_;
};

void Check::distances() {
    at_least("dmax_mm", profile_.dmax_mm, 2);
    at_most("dmin_mm", profile_.dmin_mm, profile_.dmax_mm - 1, ", below dmax_mm");
    at_most("dmax_mm", profile_.dmax_mm, largest_value, ", the largest that SCIP can say");
    at_most("nearest_mm", profile_.nearest_mm, profile_.dmax_mm - 1, ", below dmax_mm");
}

void Check::steps() {
    at_least("ares", profile_.ares, 2);
    at_most("amin", profile_.amin, profile_.afrt, ", afrt");
    at_most("afrt", profile_.afrt, profile_.amax, ", amax");
    at_most("amax", profile_.amax, profile_.ares - 1, ", below ares");
    at_most("first_step", profile_.first_step, profile_.amin, ", amin");
    at_most("amax", profile_.amax, profile_.last_step, ", last_step");
    at_most("last_step", profile_.last_step, profile_.ares - 1, ", below ares");
    at_most("last_step", profile_.last_step, largest_step, ", the largest that SCIP can say");
}

void Check::speed() {
    at_most("turns_per_reply", profile_.turns_per_reply, most_turns_per_reply, "");
    using Milliseconds = std::chrono::duration<double, std::milli>;
    const double period_ms = Milliseconds(profile_.scan_period).count();
    if (period_ms < fastest_turn_ms || period_ms > slowest_turn_ms)
        add("scan_period_ms", "must be 1 to 10000 ms");
    at_least("scan_rpm", profile_.scan_rpm, 1);
    if (profile_.scan_rpm < 1) return;
    const double nominal_ms = 60'000.0 / profile_.scan_rpm;
    if (std::abs(period_ms - nominal_ms) > most_turn_error * nominal_ms) {
        add("scan_period_ms", "must be within 5 % of what scan_rpm says, " +
                                  std::to_string(std::lround(nominal_ms)) + " ms");
    }
}

void Check::codes() {
    const protocol::DistanceCodes& codes = profile_.codes;
    const std::pair<const char*, std::optional<std::uint32_t>> all[] = {
        {"nothing", codes.nothing},   {"too_near", codes.too_near},
        {"too_far", codes.too_far},   {"not_measured", codes.not_measured},
        {"too_dark", codes.too_dark}, {"too_bright", codes.too_bright},
        {"edge", codes.edge},         {"interference", codes.interference},
        {"lost", codes.lost}};
    for (const auto& [name, value] : all)
        if (value) code("codes", name, *value);
}

void Check::code(std::string_view member, std::string_view name, std::uint32_t code) {
    if (code > largest_value) {
        add(member, std::string(name) + " must be at most " + std::to_string(largest_value) +
                        ", the largest that SCIP can say");
    } else if (profile_.is_distance(code)) {
        add(member, std::string(name) + " " + std::to_string(code) +
                        " is a distance: use one below nearest_mm or above dmax_mm");
    }
}

void Check::rare_codes() {
    using protocol::RareCode;
    for (const RareCode& rare : profile_.rare_codes)
        code("rare_codes", "code", rare.code);
    constexpr std::pair<const char*, double RareCode::*> places[] = {
        {"inside", &RareCode::inside}, {"beside", &RareCode::beside}, {"edge", &RareCode::edge}};
    for (const auto& [name, share] : places) {
        double together = 0.0;
        for (const RareCode& rare : profile_.rare_codes)
            together += rare.*share * (rare.alone ? 4.0 : 1.0);
        if (together >= 1.0)
            add("rare_codes", std::string(name) +
                                  " must be less than 1 in all, where a code that "
                                  "stands alone counts four times: it has one step in four");
    }
}

void Check::abilities() {
    const auto needs = [this](std::string_view member, bool given, bool can) {
        if (given && !can) add(member, "is nothing that this family can do; leave it out");
    };
    const auto family = profile_.family;
    needs("multi_echo", profile_.multi_echo, family_can(family, Feature::multi_echo));
    needs("microseconds", profile_.microseconds, family_can(family, Feature::microseconds));
    needs("io_lines", profile_.io_lines, family_can(family, Feature::io_lines));
    // In all other families GE and ME need it.
    needs("intensity_codes", profile_.intensity_codes, !family_can(family, "ME"));
    needs("bit_rates", !profile_.bit_rates.empty(), family_can(family, "SS"));
    needs("motor_levels", profile_.motor_levels, family_can(family, "CR"));
    needs("sensitivity", profile_.sensitivity != Support::never, family_can(family, "HS"));
    needs("rehearsals", profile_.rehearsals != Support::never, family_can(family, "DB"));
    if (profile_.sensitivity == Support::yes && profile_.mode_sensitive.empty())
        add("mode_sensitive", "must be given where sensitivity is yes");
}

void Check::bit_rates() {
    const std::vector<int>& rates = profile_.bit_rates;
    for (auto rate = rates.begin(); rate != rates.end(); ++rate) {
        if (*rate < slowest_bit_rate || *rate > fastest_bit_rate) {
            add("bit_rates", std::to_string(*rate) + " must be " +
                                 std::to_string(slowest_bit_rate) + " to " +
                                 std::to_string(fastest_bit_rate));
        } else if (std::find(rates.begin(), rate, *rate) != rate) {
            add("bit_rates", std::to_string(*rate) + " is there twice; keep one");
        }
    }
}

}  // namespace

std::vector<ProfileFault> faults_of(const DeviceProfile& profile) {
    return Check(profile).faults();
}

}  // namespace scipd::daemon
