// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One scan of a recording, exactly as it was recorded: no range is rounded, and no code is taken
// for a range. Beside it the bytes of a conversation with a scanner. Values; no thread rule.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/recording/values/scanner_identity.h"

namespace scipd::sim {

/// Since 1970, on the clock of the machine that recorded.
using HostTime = std::chrono::time_point<std::chrono::system_clock, std::chrono::nanoseconds>;

/// What lies beyond the years 1678 to 2262 becomes the nearest of them: nanoseconds have no room.
[[nodiscard]] inline HostTime host_time_at(std::int64_t unix_s, std::int64_t nanoseconds = 0) {
    constexpr std::int64_t most_s = 9'200'000'000;
    const std::chrono::seconds seconds{std::clamp(unix_s, -most_s, most_s)};
    return HostTime(seconds + std::chrono::nanoseconds(nanoseconds % 1'000'000'000));
}

/// Directions of the values of a scan, in the steps of SCIP and in angles. Facts that the recording
/// does not have are empty.
struct Directions {
    std::optional<int> first_step;        ///< SCIP's number of the step that the first value is of
    int cluster = 1;                      ///< neighbouring steps that share one value
    std::optional<double> first_rad;      ///< counter-clockwise from forward
    std::optional<double> increment_rad;  ///< from one value to the next

    bool operator==(const Directions&) const = default;
};

/// With the angles that follow from the steps, if the scanner says which step looks forward and how
/// many there are in a turn.
[[nodiscard]] Directions with_angles(Directions directions, const ScannerIdentity& identity);

/// The reverse: what steps and angles together say of the scanner's turn.
void learn_turn(const Directions& directions, ScannerIdentity& identity);

enum class RangeUnit {
    millimetres,  ///< whole ones and codes for "no distance", as a scanner sends them
    metres,       ///< NaN and infinities stand for "no distance"
};

/// Unit of ranges whose file does not tell it: a guess by all that are shown to it.
class LikelyUnit {
  public:
    /// `point`: it is written with one, or as what holds fractions.
    void show(double range, bool point) {
        // Codes of SCIP stand for no distance, and 0 for none at all.
        constexpr double codes = 20;
        constexpr double farthest_m = 100;
        if (!std::isfinite(range)) return;
        points_ = points_ || point;
        if (range < codes && range == std::floor(range)) return;
        ++(range > farthest_m ? beyond_ : within_);
    }

    /// Millimetres if none has a point, or if most, taken as metres, are farther than scanners see.
    [[nodiscard]] RangeUnit unit() const {
        return !points_ || beyond_ > within_ ? RangeUnit::millimetres : RangeUnit::metres;
    }

  private:
    bool points_ = false;
    std::size_t beyond_ = 0;
    std::size_t within_ = 0;
};

/// Where a laser was, in the plane and counter-clockwise: by its robot's odometry, or as a program
/// that makes maps has corrected that.
struct LaserPose {
    double x_m = 0.0;
    double y_m = 0.0;
    double yaw_rad = 0.0;
    bool operator==(const LaserPose&) const = default;
};

struct RecordedScan {
    std::optional<HostTime> host_time;      ///< when it came, or when it was measured if known
    std::optional<std::uint32_t> stamp_ms;  ///< the scanner's clock at step 0: 24 bits, or...
    std::optional<std::uint64_t> stamp_us;  ///< ...microseconds
    Directions directions;
    std::optional<LaserPose> pose;  ///< of its step 0, in the recording's own frame
    RangeUnit unit = RangeUnit::millimetres;
    /// Step by step, all echoes of a step near to far.
    std::vector<double> ranges;
    std::vector<double> intensities;  ///< one for each range; empty: not recorded
    /// For each step, how many of `ranges` there are up to its last. Empty: one a step.
    std::vector<std::uint32_t> echo_ends;

    [[nodiscard]] std::size_t steps() const {
        return echo_ends.empty() ? ranges.size() : echo_ends.size();
    }
    [[nodiscard]] bool has_echoes() const { return !echo_ends.empty(); }

    /// A step that met nothing may have none.
    [[nodiscard]] std::span<const double> ranges_of(std::size_t step) const {
        return of(step, ranges);
    }
    /// As many as ranges_of(), or none where they were not recorded.
    [[nodiscard]] std::span<const double> intensities_of(std::size_t step) const {
        return intensities.empty() ? std::span<const double>{} : of(step, intensities);
    }

    /// The NaN of one equals no NaN of the other.
    bool operator==(const RecordedScan&) const = default;

  private:
    [[nodiscard]] std::span<const double> of(std::size_t step,
                                             const std::vector<double>& values) const {
        const std::size_t begin = echo_ends.empty() ? step : (step == 0 ? 0 : echo_ends[step - 1]);
        const std::size_t end = echo_ends.empty() ? step + 1 : echo_ends[step];
        return std::span(values).subspan(begin, end - begin);
    }
};

enum class Way { to_scanner, from_scanner };

/// Bytes as they were on the wire. Their meaning is not known here.
struct RecordedBytes {
    Way way = Way::from_scanner;
    HostTime host_time{};  ///< when the recorder sent or got them
    std::string bytes;

    bool operator==(const RecordedBytes&) const = default;
};

/// A recorded value: a distance, or what stands in its place.
struct RecordedReading {
    enum class Kind {
        distance,
        nothing,   ///< NaN, 0 m, a negative value
        too_near,  ///< -infinity (REP 117)
        too_far,   ///< +infinity, and what lies beyond the scanner's range
        code,      ///< a code of SCIP below 20, or from 65533 on
    };
    Kind kind = Kind::nothing;
    double range_m = 0.0;    ///< of a distance
    std::uint32_t code = 0;  ///< of a code
};

/// Drivers publish the code c of SCIP as c / 1000 m: what is exactly that, and outside of the
/// scanner's range, is the code again. Without a range in the identity, 20 mm to 65532 mm are
/// distances.
[[nodiscard]] RecordedReading reading_of(double value, RangeUnit unit,
                                         const ScannerIdentity& identity);

/// Scanners that hang upside down look the other way round, and their drivers tell angles that go
/// down. The same scan with its steps counter-clockwise.
[[nodiscard]] RecordedScan counter_clockwise(RecordedScan scan);

}  // namespace scipd::sim
