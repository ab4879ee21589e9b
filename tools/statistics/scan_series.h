// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Scans of one scanner that look the same way, as a table of readings: a row a scan, a column a
// beam. Of each beam the first echo. Of one owner; any thread.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/recording/values/recorded_scan.h"
#include "sim/recording/values/scanner_identity.h"

namespace scipd::tools {

/// Why a reading is no distance: a code of SCIP, or one of these.
using Code = std::int32_t;
namespace codes {
/// However the file writes it: no echo, NaN, infinity, 0, 1 (UTM, UXM), 65533 (UST), or a value
/// outside of the scanner's range.
inline constexpr Code nothing = -1;
/// The reading is a distance.
inline constexpr Code distance = std::numeric_limits<Code>::min();
}  // namespace codes

/// "no distance", or the number of another code, such as "6".
[[nodiscard]] std::string name_of_code(Code code);

/// In seconds. Each clock begins somewhere.
struct ScanTime {
    std::optional<double> stamp_s;  ///< of the scanner's clock, which does not wrap here
    std::optional<double> host_s;   ///< when it came
};

class ScanSeries {
  public:
    /// The range in the identity says what is a distance (sim::reading_of).
    explicit ScanSeries(sim::ScannerIdentity identity) : identity_(std::move(identity)) {}

    /// A scan that comes twice, since its client polls faster than the mirror turns, is counted and
    /// left out. So is one of another length or direction than the first.
    void add(const sim::RecordedScan& scan);
    /// The recording may learn on its way who the scanner is.
    void learn(const sim::ScannerIdentity& identity) { identity_ = identity; }

    [[nodiscard]] const sim::ScannerIdentity& identity() const { return identity_; }
    [[nodiscard]] const sim::Directions& directions() const { return directions_; }
    [[nodiscard]] std::size_t scans() const { return times_.size(); }
    [[nodiscard]] std::size_t beams() const { return beams_; }
    [[nodiscard]] std::size_t doubles() const { return doubles_; }
    [[nodiscard]] std::size_t odd_ones() const { return odd_ones_; }
    /// In every scan.
    [[nodiscard]] bool has_intensities() const { return !intensities_.empty(); }
    /// The smallest difference of two stamps: a millisecond or a microsecond.
    [[nodiscard]] double tick_s() const { return tick_s_; }

    /// NaN where there is none.
    [[nodiscard]] double range_mm(std::size_t scan, std::size_t beam) const {
        return ranges_mm_[scan * beams_ + beam];
    }
    [[nodiscard]] Code code(std::size_t scan, std::size_t beam) const {
        return codes_[scan * beams_ + beam];
    }
    /// How bright a reading is that is a distance; NaN for others.
    [[nodiscard]] double intensity(std::size_t scan, std::size_t beam) const {
        return intensities_[scan * beams_ + beam];
    }
    [[nodiscard]] const std::vector<ScanTime>& times() const { return times_; }

  private:
    [[nodiscard]] bool is_double(const sim::RecordedScan& scan) const;
    void add_readings(const sim::RecordedScan& scan);
    void add_time(const sim::RecordedScan& scan);

    sim::ScannerIdentity identity_;
    sim::Directions directions_;
    sim::RecordedScan last_;
    std::size_t beams_ = 0;
    std::size_t doubles_ = 0;
    std::size_t odd_ones_ = 0;
    double tick_s_ = 1e-3;
    std::vector<float> ranges_mm_;
    std::vector<Code> codes_;
    std::vector<float> intensities_;
    std::vector<ScanTime> times_;
    std::optional<sim::HostTime> first_host_time_;
};

}  // namespace scipd::tools
