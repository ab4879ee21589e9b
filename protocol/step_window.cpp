// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/step_window.h"

#include <algorithm>

#include "protocol/char_code.h"

namespace scipd::protocol {
namespace {

std::optional<std::size_t> index_of(const ScanView& scan, int step) {
    const int index = step - scan.first_step;
    if (index < 0 || index >= static_cast<int>(scan.distance.size())) return std::nullopt;
    return static_cast<std::size_t>(index);
}

std::uint32_t distance_at(const ScanView& scan, int step, const DeviceProfile& profile) {
    const auto index = index_of(scan, step);
    return index ? scan.distance[*index] : profile.codes.not_measured;
}

std::uint32_t intensity_at(const ScanView& scan, int step) {
    const auto index = index_of(scan, step);
    return index ? scan.intensity[*index] : 0;
}

// Nearly every client asks for every distance of steps that are all measured: a plain copy, a tenth
// of what going step by step takes.
bool is_plain_copy(const ScanView& scan, const StepWindow& window, DataFormat format) {
    return window.cluster == 1 && window.contents == Contents::distances && format.width == 3 &&
           !format.intensity && window.first >= scan.first_step &&
           window.last < scan.first_step + static_cast<int>(scan.distance.size());
}

// What two characters cannot hold is as good as not seen: the URG-04LX gives its range as 20 to
// 4095 mm in that form (its SCIP 1.1 version text). That the UTM-30LX does so too is deduced.
std::uint32_t fitting(std::uint32_t distance, int width, const DeviceProfile& profile) {
    return distance <= max_encoded(width) ? distance : profile.codes.nothing;
}

// The emulated receivers are alike, so their mean is either of them. How the gain follows is
// assumed: the weaker the return, the higher.
std::uint32_t gain_for(std::uint32_t intensity) {
    constexpr std::uint32_t full_gain = 1023;
    return full_gain - std::min(intensity / 16, full_gain);
}

std::vector<std::uint32_t> contents_of(const ScanView& scan, const StepWindow& window, int width,
                                       const DeviceProfile& profile) {
    const auto most = static_cast<std::uint32_t>(max_encoded(width));
    const bool pairs = window.contents == Contents::distance_and_intensity ||
                       window.contents == Contents::intensity_and_gain;
    std::vector<std::uint32_t> values;
    for (int step = window.first; step <= window.last; ++step) {
        const bool second = pairs && (step - window.first) % 2 == 1;
        const int shown = second ? step - 1 : step;
        const std::uint32_t intensity = std::min(intensity_at(scan, shown), most);
        if (window.contents == Contents::distance_and_intensity && !second) {
            values.push_back(fitting(distance_at(scan, shown, profile), width, profile));
        } else if (window.contents == Contents::gain ||
                   (second && window.contents == Contents::intensity_and_gain)) {
            values.push_back(gain_for(intensity));
        } else {
            values.push_back(intensity);
        }
    }
    return values;
}

}  // namespace

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
    if (!first) return Status("01");
    const auto last = parse_digits(digits.substr(4, 4));
    if (!last) return Status("02");
    const auto contents =
        profile.intensity_codes ? parse_contents(digits.substr(8, 2)) : std::nullopt;
    const auto cluster = contents ? 1 : parse_digits(digits.substr(8, 2));
    if (!cluster) return Status("03");
    if (*first < profile.first_step || *last > profile.last_step) return Status("04");
    if (*last < *first) return Status("05");
    return StepWindow{.first = *first,
                      .last = *last,
                      .cluster = std::max(*cluster, 1),
                      .contents = contents.value_or(Contents::distances)};
}

int nearest_step(const ScanView& scan, int first, int last, bool echoes,
                 const DeviceProfile& profile) {
    const auto distance = [&](int step) {
        const auto index = index_of(scan, step);
        if (echoes && index && !scan.echoes.empty())
            return scan.echoes[*index].echo.front().distance;
        return distance_at(scan, step, profile);
    };
    int nearest = first;
    for (int step = first + 1; step <= last; ++step) {
        if (!profile.is_distance(distance(step))) continue;
        if (!profile.is_distance(distance(nearest)) || distance(step) < distance(nearest))
            nearest = step;
    }
    return nearest;
}

std::vector<std::uint32_t> values_in(const ScanView& scan, const StepWindow& window,
                                     DataFormat format, const DeviceProfile& profile) {
    const int steps = window.last - window.first + 1;
    if (is_plain_copy(scan, window, format)) {
        const auto covered = scan.distance.subspan(window.first - scan.first_step, steps);
        return {covered.begin(), covered.end()};
    }
    if (window.contents != Contents::distances)
        return contents_of(scan, window, format.width, profile);
    std::vector<std::uint32_t> values;
    values.reserve(static_cast<std::size_t>(2 * (steps / window.cluster + 1)));
    for (int first = window.first; first <= window.last; first += window.cluster) {
        const int last = std::min(first + window.cluster - 1, window.last);
        const int step = nearest_step(scan, first, last, false, profile);
        values.push_back(fitting(distance_at(scan, step, profile), format.width, profile));
        if (format.intensity) values.push_back(intensity_at(scan, step));
    }
    return values;
}

}  // namespace scipd::protocol
