// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/step_window.h"

#include <algorithm>

namespace scipd::protocol {

std::optional<int> parse_digits(std::string_view digits) {
    int value = 0;
    for (const char c : digits) {
        if (c < '0' || c > '9') return std::nullopt;
        value = 10 * value + (c - '0');
    }
    return value;
}

std::optional<Contents> parse_contents(std::string_view cluster) {
    if (cluster == "FF" || cluster == "FE" || cluster == "FD")
        return Contents::distance_and_intensity;
    if (cluster == "EF" || cluster == "EE" || cluster == "ED") return Contents::intensity;
    if (cluster == "DF" || cluster == "DE" || cluster == "DD") return Contents::intensity_and_gain;
    if (cluster == "DC" || cluster == "DB") return Contents::gain;
    return std::nullopt;
}

std::variant<StepWindow, Status> parse_step_window(std::string_view digits,
                                                   const DeviceProfile& profile) {
    const auto first = parse_digits(digits.substr(0, 4));
    if (!first) return status::scan::start_not_numeric;
    const auto last = parse_digits(digits.substr(4, 4));
    if (!last) return status::scan::end_not_numeric;
    const auto contents =
        profile.intensity_codes ? parse_contents(digits.substr(8, 2)) : std::nullopt;
    const auto cluster = contents ? 1 : parse_digits(digits.substr(8, 2));
    if (!cluster) return status::scan::cluster_not_numeric;
    if (*first < profile.first_step || *last > profile.last_step) return status::scan::no_such_step;
    if (*last < *first) return status::scan::end_before_start;
    return StepWindow{.first = *first,
                      .last = *last,
                      .cluster = std::max(*cluster, 1),
                      .contents = contents.value_or(Contents::distances)};
}

}  // namespace scipd::protocol
