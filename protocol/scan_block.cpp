// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/scan_block.h"

#include <algorithm>
#include <optional>
#include <span>
#include <string>

#include "protocol/char_code.h"
#include "protocol/timestamp.h"

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

// Nearly every client asks for every distance of steps that are all measured. To take them as they
// are takes a tenth of the time of going step by step.
std::optional<std::span<const std::uint32_t>> as_they_are(const ScanView& scan,
                                                          const StepWindow& window,
                                                          DataFormat format) {
    const int behind = scan.first_step + static_cast<int>(scan.distance.size());
    if (window.cluster != 1 || window.contents != Contents::distances || format.width != 3 ||
        format.intensity || window.first < scan.first_step || window.last >= behind)
        return std::nullopt;
    return scan.distance.subspan(window.first - scan.first_step, window.last - window.first + 1);
}

// A distance that two characters cannot hold counts as not seen: the URG-04LX gives its range as 20
// to 4095 mm in that form (its SCIP 1.1 version text). That the UTM-30LX does so too is deduced.
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

/// The step that speaks for a group: the one with the nearest distance, the first of several such.
/// Where there is no distance, the first of the group.
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

// Says that another echo of the same step follows. No value can begin with it: values begin with
// '0' or a later character.
constexpr char further_echo = '&';

StepEchoes echoes_at(const ScanView& scan, int step, const DeviceProfile& profile) {
    const int index = step - scan.first_step;
    if (index < 0 || index >= static_cast<int>(scan.distance.size()))
        return {.echo = {Echo{.distance = profile.codes.not_measured}}};
    if (!scan.echoes.empty()) return scan.echoes[index];
    return {.echo = {Echo{scan.distance[index], scan.intensity[index]}}};
}

// The echoes of the nearest step stand for a group of steps. How real scanners group echoes is
// undocumented.
std::string echoes_in(const ScanView& scan, const StepWindow& window, DataFormat format,
                      const DeviceProfile& profile) {
    std::string characters;
    for (int first = window.first; first <= window.last; first += window.cluster) {
        const int last = std::min(first + window.cluster - 1, window.last);
        const StepEchoes step =
            echoes_at(scan, nearest_step(scan, first, last, true, profile), profile);
        for (int i = 0; i < step.count; ++i) {
            if (i > 0) characters.push_back(further_echo);
            append_encoded(characters, step.echo[i].distance, format.width);
            if (format.intensity) append_encoded(characters, step.echo[i].intensity, format.width);
        }
    }
    return characters;
}

std::string io_words(const IoWords& io) {
    constexpr int word_width = 3;
    std::string characters;
    append_encoded(characters, io.inputs, word_width);
    append_encoded(characters, io.outputs, word_width);
    return characters;
}

}  // namespace

std::vector<std::uint32_t> values_in(const ScanView& scan, const StepWindow& window,
                                     DataFormat format, const DeviceProfile& profile) {
    const int steps = window.last - window.first + 1;
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

void add_scan(Reply& reply, const ScanView& scan, const StepWindow& window, DataFormat format,
              const DeviceState& device, const DeviceProfile& profile) {
    if (format.io_lines) reply.line(io_words(device.io()));
    reply.line(format.stamp == Stamp::microseconds
                   ? encoded_microseconds(scan.turn.start, device.clock_zero())
                   : encoded_timestamp(scan.turn.start, device.clock_zero()));
    if (format.echoes) {
        reply.data(echoes_in(scan, window, format, profile));
    } else if (const auto distances = as_they_are(scan, window, format)) {
        reply.data(*distances, format.width);
    } else {
        reply.data(values_in(scan, window, format, profile), format.width);
    }
}

}  // namespace scipd::protocol
