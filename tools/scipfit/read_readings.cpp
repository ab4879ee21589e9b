// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/read_readings.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "daemon/recording/decoded_recording.h"
#include "sim/recording/recording_files.h"
#include "tools/options.h"
#include "tools/scipfit/chosen_stream.h"

namespace scipd::tools {
namespace {

using sim::RecordedScan;

/// Which of several echoes a scanner with single echoes tells: the brightest, or the first where
/// they have no intensities.
std::size_t told_echo(std::span<const double> intensities) {
    if (intensities.empty()) return 0;
    return static_cast<std::size_t>(std::ranges::max_element(intensities) - intensities.begin());
}

float as_mm(double range, sim::RangeUnit unit) {
    constexpr double mm_per_m = 1000.0;
    // No scanner sees so far; what is larger has more digits than a float.
    constexpr double most_mm = 1e6;
    const double mm = unit == sim::RangeUnit::metres ? range * mm_per_m : range;
    return mm >= 0.0 && mm <= most_mm ? static_cast<float>(mm) : no_value;
}

/// 0: none.
float as_light(double intensity) {
    return std::isfinite(intensity) && intensity > 0.0 ? static_cast<float>(intensity) : 0.0F;
}

/// Adds scans to readings, one after the other.
class Reader {
  public:
    Reader(const std::string& file, Readings& readings) : file_(file), readings_(readings) {}

    void add(const RecordedScan& scan) {
        if (readings_.steps == 0) begin(scan);
        if (scan.steps() != readings_.steps)
            throw WrongInput(file_ + ": has scans of " + std::to_string(scan.steps()) +
                             " steps after others of " + std::to_string(readings_.steps) +
                             "; name recordings of one scanner with the same steps");
        const std::size_t at = readings_.mm.size();
        for (std::size_t step = 0; step < scan.steps(); ++step)
            add(scan.ranges_of(step), scan.intensities_of(step), scan.unit);
        if (came_twice(scan, at)) {
            readings_.mm.resize(at);
            readings_.intensity.resize(at);
            ++readings_.doubles;
        }
        stamped_ = scan.stamp_ms.has_value();
        stamp_ms_ = scan.stamp_ms.value_or(0);
    }

    void finish(const std::vector<double>& host_s) {
        if (host_s.size() > 1 && readings_.period_s == 0.0)
            readings_.period_s =
                (host_s.back() - host_s.front()) / static_cast<double>(host_s.size() - 1);
        readings_.begins.push_back(readings_.scans());
    }

  private:
    void begin(const RecordedScan& scan) {
        readings_.steps = scan.steps();
        readings_.has_codes = scan.unit == sim::RangeUnit::millimetres;
        readings_.first_step = scan.directions.first_step.value_or(0);
        readings_.first_rad = scan.directions.first_rad.value_or(0.0);
        readings_.beam_rad = scan.directions.increment_rad.value_or(0.0);
    }

    void add(std::span<const double> ranges, std::span<const double> intensities,
             sim::RangeUnit unit) {
        const std::size_t echo = told_echo(intensities);
        readings_.mm.push_back(ranges.empty() ? no_value : as_mm(ranges[echo], unit));
        readings_.intensity.push_back(intensities.empty() ? 0.0F : as_light(intensities[echo]));
    }

    /// A client that polls faster than the mirror turns gets a scan again. Two scans of a real
    /// scanner are never alike, but nor are those of one that has no noise.
    [[nodiscard]] bool came_twice(const RecordedScan& scan, std::size_t at) const {
        if (at < (readings_.begins.back() + 1) * readings_.steps) return false;
        if (scan.stamp_ms && stamped_) return *scan.stamp_ms == stamp_ms_;
        const auto now = readings_.mm.begin() + static_cast<std::ptrdiff_t>(at);
        return std::equal(now, readings_.mm.end(),
                          now - static_cast<std::ptrdiff_t>(readings_.steps));
    }

    const std::string& file_;
    Readings& readings_;
    bool stamped_ = false;  ///< the scan before has a stamp, which is:
    std::uint32_t stamp_ms_ = 0;
};

void take_identity(const sim::ScannerIdentity& identity, const std::string& name,
                   Readings& readings) {
    const std::string& known = readings.identity.model;
    if (known.empty()) {
        readings.identity = identity;
    } else if (!identity.model.empty() && identity.model != known) {
        throw WrongInput(name + ": is of a " + identity.model + ", the recording before of a " +
                         known + "; name recordings of one scanner");
    }
}

bool has_light(const Readings& readings) {
    return std::ranges::any_of(readings.intensity, [](float value) { return value > 0.0F; });
}

bool in_whole_mm(const Readings& readings) {
    constexpr float rounded = 0.02F;  // of metres in 32 bits
    return std::ranges::all_of(readings.mm, [](float mm) {
        return !is_distance(mm) || std::abs(mm - std::round(mm)) < rounded;
    });
}

/// Metres in 32 bits are not quite the millimetres that were sent.
float whole(float mm) {
    return is_distance(mm) ? std::round(mm) : mm;
}

}  // namespace

void add_scans(sim::Recording& recording, const std::string& name, const std::string& stream,
               Readings& readings) {
    readings.intensity.resize(readings.mm.size(), 0.0F);  // recordings before may have none
    Reader reader(name, readings);
    std::vector<double> host_s;
    const std::size_t chosen =
        for_each_scan(recording, name, stream, [&](const auto& scan, const auto&) {
            reader.add(scan);
            if (scan.host_time)
                host_s.push_back(
                    std::chrono::duration<double>(scan.host_time->time_since_epoch()).count());
        });
    take_identity(recording.streams()[chosen].identity, name, readings);
    reader.finish(host_s);
    readings.files +=
        (readings.files.empty() ? "" : ", ") + std::filesystem::path(name).filename().string();
    readings.has_intensities = has_light(readings);
    if (!readings.has_intensities) readings.intensity.clear();
    readings.whole_mm = in_whole_mm(readings);
    if (readings.whole_mm) std::ranges::transform(readings.mm, readings.mm.begin(), whole);
}

Readings read_readings(std::span<const std::filesystem::path> files, const std::string& stream) {
    Readings readings;
    for (const std::filesystem::path& file : files) {
        const auto recording = daemon::open_scans(sim::split_paths(file.string()));
        if (!recording) throw WrongInput(recording.error().why);
        add_scans(**recording, file.string(), stream, readings);
    }
    return readings;
}

}  // namespace scipd::tools
