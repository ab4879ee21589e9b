// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/settings.h"

#include <algorithm>

#include "protocol/step_window.h"

namespace scipd::protocol {
namespace {

constexpr int slowest_level = 10;
constexpr int initial_speed = 99;  // CR99: as at power-up

}  // namespace

int bit_rate_of(const Settings& settings, const DeviceProfile& profile) {
    if (profile.bit_rates.empty()) return 0;
    return settings.bit_rate == 0 ? profile.bit_rates.front() : settings.bit_rate;
}

Status set_bit_rate(Settings& settings, std::string_view digits, const DeviceProfile& profile) {
    const auto& rates = profile.bit_rates;
    if (rates.empty()) return status::setting::fixed;
    const auto rate = parse_digits(digits);
    if (!rate) return status::setting::not_numeric;
    if (std::find(rates.begin(), rates.end(), *rate) == rates.end())
        return status::setting::not_offered;
    if (*rate == bit_rate_of(settings, profile)) return status::setting::unchanged;
    settings.bit_rate = *rate;
    return status::ok;
}

Status set_motor_level(Settings& settings, std::string_view digits, const DeviceProfile& profile) {
    if (!profile.motor_levels) return status::setting::fixed;
    auto level = parse_digits(digits);
    if (!level) return status::setting::not_numeric;
    if (*level == initial_speed) level = 0;
    if (*level > slowest_level) return status::setting::not_offered;
    if (*level == settings.motor_level) return status::setting::unchanged;
    settings.motor_level = *level;
    return status::ok;
}

Status set_sensitivity(Settings& settings, std::string_view digits, const DeviceProfile& profile) {
    if (profile.sensitivity == Support::never) return status::sensitivity::fixed;
    if (profile.sensitivity == Support::later_firmware) return status::too_short;
    if (digits != "0" && digits != "1") return status::sensitivity::neither_on_nor_off;
    const bool sensitive = digits == "1";
    if (sensitive == settings.sensitive) return status::sensitivity::unchanged;
    settings.sensitive = sensitive;
    return status::ok;
}

Status check_addresses(std::string_view digits) {
    constexpr std::size_t octet_digits = 3;
    constexpr int largest_octet = 255;
    for (; !digits.empty(); digits.remove_prefix(octet_digits)) {
        const auto octet = parse_digits(digits.substr(0, octet_digits));
        if (!octet || *octet > largest_octet) return status::no_address;
    }
    return status::ok;
}

}  // namespace scipd::protocol
