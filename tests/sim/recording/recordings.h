// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Scans to write, and what can be read of a recording. Values; no thread rule.
#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sim/recording/open_recording.h"

namespace scipd::tests {

/// All that a recording gives, until it ends or has a fault.
struct ReadBack {
    std::string format;
    std::vector<sim::RecordedStream> streams;
    std::vector<sim::RecordedItem> items;
    std::vector<std::string> warnings;
    std::string fault;  ///< empty: none

    [[nodiscard]] std::vector<sim::RecordedScan> scans() const {
        std::vector<sim::RecordedScan> scans;
        for (const auto& item : items) {
            if (const auto* const scan = std::get_if<sim::RecordedScan>(&item.what))
                scans.push_back(*scan);
        }
        return scans;
    }
    [[nodiscard]] std::vector<sim::RecordedBytes> bytes() const {
        std::vector<sim::RecordedBytes> all;
        for (const auto& item : items) {
            if (const auto* const bytes = std::get_if<sim::RecordedBytes>(&item.what))
                all.push_back(*bytes);
        }
        return all;
    }
};

inline ReadBack read_all(sim::Expected<std::unique_ptr<sim::Recording>> opened) {
    ReadBack back;
    if (!opened) {
        back.fault = opened.error().why;
        return back;
    }
    sim::Recording& recording = **opened;
    for (;;) {
        auto item = recording.next();
        if (!item) back.fault = item.error().why;
        if (!item || !*item) break;
        back.items.push_back(std::move(**item));
    }
    back.format = recording.format();
    back.streams = recording.streams();
    back.warnings = recording.warnings();
    return back;
}

inline ReadBack read_back(const std::filesystem::path& path) {
    return read_all(sim::open_recording(path));
}

inline ReadBack read_bytes(std::string bytes) {
    return read_all(sim::open_recording(sim::InputFile::of_bytes("FILE", std::move(bytes))));
}

inline std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// A scanner with all that can be known of one.
inline sim::ScannerIdentity some_scanner() {
    return {.model = "UTM-30LX-EW",
            .serial = "H1200046",
            .firmware = "1.1.0(2012)",
            .min_range_m = 0.023,
            .max_range_m = 60.0,
            .steps_per_turn = 1440,
            .front_step = 540,
            .rpm = 2400.0,
            .version = {{"VEND", "Hokuyo Automatic Co.,Ltd."}, {"SERI", "H1200046"}},
            .parameters = {{"MODL", "UTM-30LX-EW"}, {"DMIN", "23"}, {"DMAX", "60000"}},
            .state = {{"LASR", "OFF"}, {"STAT", "Sensor works well."}}};
}

enum class Values { ranges, intensities, echoes, echoes_with_intensities };

/// The nth of a stream of scans of five values, with codes among them.
inline sim::RecordedScan some_scan(unsigned n, Values values = Values::ranges, int cluster = 1) {
    sim::RecordedScan scan;
    scan.host_time = sim::HostTime(std::chrono::milliseconds(1'769'860'800'000 + 25 * n));
    scan.stamp_ms = (16'777'200 + 25 * n) % (1U << 24);
    scan.directions = with_angles({.first_step = 44, .cluster = cluster}, some_scanner());
    const double range = 1000.0 + n;
    const bool echoes = values == Values::echoes || values == Values::echoes_with_intensities;
    scan.ranges = echoes ? std::vector{range, range + 500, 1.0, 23.0, 65533.0, 7.0, 9.0, 11.0}
                         : std::vector{range, 1.0, 23.0, 65533.0, 60000.0};
    if (echoes) scan.echo_ends = {2, 3, 4, 5, 8};
    if (values == Values::intensities || values == Values::echoes_with_intensities) {
        for (const double value : scan.ranges)
            scan.intensities.push_back(std::round(value / 10));
    }
    return scan;
}

}  // namespace scipd::tests
