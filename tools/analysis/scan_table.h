// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// All scans of one scanner in memory, as a table: a row per scan, a column per beam. A recording
// keeps more; open_recorded() and read_scans() are the way from the one to the other. Of one owner;
// any thread.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/recording/values/recording.h"

namespace scipd::tools {

/// The number that stands in place of a distance, as the scanner sent it, or one of `codes`.
using Code = std::int32_t;
namespace codes {
/// The reading is a distance.
inline constexpr Code distance = std::numeric_limits<Code>::min();
// No number is known:
inline constexpr Code nothing = -1;   ///< NaN, 0 m, or no echo
inline constexpr Code too_near = -2;  ///< -infinity, or metres below the scanner's range
inline constexpr Code too_far = -3;   ///< +infinity, or metres beyond the scanner's range
}  // namespace codes

/// The same recording has NaN, an infinity, 0, 1 (UTM, UXM) or 65533 (UST) where there is no
/// distance, by its format and driver. All of these are of the class codes::nothing, and so are
/// values outside of the scanner's range. The codes 2 to 19 are classes of their own.
[[nodiscard]] Code class_of(Code code);
/// "no distance", or the number of another class, such as "6".
[[nodiscard]] std::string name_of_code(Code code);

/// One of several echoes of a beam.
enum class Echo {
    first,
    brightest,  ///< as scanners with single echoes report; the first if there are no intensities
};

inline constexpr float no_number = std::numeric_limits<float>::quiet_NaN();

struct Reading {
    float range_mm = no_number;   ///< NaN: no distance
    float intensity = no_number;  ///< NaN: no distance, or not recorded
    Code code = codes::nothing;
};
/// The range in the identity decides what is a distance (sim::reading_of).
[[nodiscard]] Reading reading_at(const sim::RecordedScan& scan, std::size_t beam, Echo echo,
                                 const sim::ScannerIdentity& identity);

[[nodiscard]] inline bool is_distance(float range_mm) {
    return !std::isnan(range_mm);
}

/// In seconds. Each clock begins somewhere.
struct ScanTime {
    std::optional<double> stamp_s;  ///< of the scanner's clock, which does not wrap here
    std::optional<double> host_s;   ///< since the first scan of the table
    bool stamped = false;           ///< `host_s` is the scan's own stamp, not that of the log
};

struct ScanTable {
    /// Adds a scan that differs. Scans that came twice, and scans of other steps than the first,
    /// are counted and left out. A scan came twice if all readings equal those of the scan before,
    /// unless their own stamps differ: noise-free scanners repeat readings. `stamped`: as
    /// sim::RecordedItem has it.
    void add(const sim::RecordedScan& scan, bool stamped = false);
    /// Adds a scan that looks_alike(), even if it came twice.
    void append(const sim::RecordedScan& scan, bool stamped = false);
    [[nodiscard]] bool looks_alike(const sim::RecordedScan& scan) const;
    /// Scans that follow are of another recording.
    void end_recording();
    /// Makes codes of distances outside of these limits.
    void limit(double nearest_mm, double farthest_mm);
    /// Removes all scans.
    void clear();

    [[nodiscard]] std::size_t scans() const { return beams == 0 ? 0 : ranges_mm.size() / beams; }
    [[nodiscard]] float range_mm(std::size_t scan, std::size_t beam) const {
        return ranges_mm[scan * beams + beam];
    }
    [[nodiscard]] float intensity(std::size_t scan, std::size_t beam) const {
        return intensities.empty() ? no_number : intensities[scan * beams + beam];
    }
    [[nodiscard]] Code code(std::size_t scan, std::size_t beam) const {
        return codes[scan * beams + beam];
    }
    [[nodiscard]] Reading reading(std::size_t scan, std::size_t beam) const {
        return {range_mm(scan, beam), intensity(scan, beam), code(scan, beam)};
    }
    /// In at least one scan, above 0.
    [[nodiscard]] bool has_intensities() const;
    /// SCIP's number of a beam's first step, or its place in the scan if there are no numbers.
    [[nodiscard]] int step_of(std::size_t beam) const {
        return directions.first_step.value_or(0) + static_cast<int>(beam) * directions.cluster;
    }
    [[nodiscard]] double beam_rad() const { return directions.increment_rad.value_or(0.0); }
    [[nodiscard]] double angle_rad(std::size_t beam) const {
        return directions.first_rad.value_or(0.0) + beam_rad() * static_cast<double>(beam);
    }
    /// Mean time between scans by the host's clock; 0: not known.
    [[nodiscard]] double period_s() const;

    std::string files;  ///< names of the recordings, for comments
    sim::ScannerIdentity identity;
    sim::Directions directions;  ///< of all scans
    Echo echo = Echo::first;
    std::size_t beams = 0;
    std::size_t doubles = 0;   ///< scans that came twice
    std::size_t odd_ones = 0;  ///< scans of another length or direction
    bool has_codes = false;    ///< some codes are numbers, as the scanner sent them
    bool whole_mm = false;     ///< all distances are whole millimetres
    double tick_s = 1e-3;      ///< resolution of the scanner's stamps
    std::optional<sim::HostTime> first_host_time;
    std::vector<std::size_t> begins = {0};  ///< where each recording begins, in scans; and the end
    std::vector<ScanTime> times;
    // Scan after scan, as many each:
    std::vector<float> ranges_mm;  ///< NaN: no distance
    std::vector<Code> codes;
    std::vector<float> intensities;  ///< NaN: no distance, or not recorded; or empty

  private:
    [[nodiscard]] bool last_came_twice() const;
    void add_time(const sim::RecordedScan& scan, bool stamped);
    void resize(std::size_t scans);
};

/// The scans of a recording that are read.
struct ScanChoice {
    std::string stream = {};  ///< empty: the first that has scans
    std::size_t most = 0;     ///< 0: all
    Echo echo = Echo::first;
    std::string option = "--stream";  ///< the option that names the stream
    std::string progress = {};        ///< before the number of scans, on a terminal
};

/// Returns true for a file, a folder or several of them; false for a scanner.
[[nodiscard]] bool is_recording(const std::string& target);
/// The target of a user: a file, the folder of a bag, or several of them, as "a.mcap+b.mcap". All
/// items are scans. Throws WrongInput if it cannot be read.
[[nodiscard]] std::unique_ptr<sim::Recording> open_recorded(const std::string& target);

/// Calls `take` with each scan of the chosen stream until it returns false; `stamped` is that of
/// the item. Returns the index of the stream. Warnings, and that there are several streams, go to
/// standard error. `name`: of the recording, for messages. Throws WrongInput if there are no scans,
/// or the recording is damaged.
using TakeScan = std::function<bool(const sim::RecordedScan& scan,
                                    const sim::RecordedStream& stream, bool stamped)>;
std::size_t for_each_scan(sim::Recording& recording, const std::string& name,
                          const ScanChoice& choice, const TakeScan& take);

/// Adds the chosen scans to the table as a recording of their own. Returns the index of the stream.
/// Throws WrongInput also if they are not of the table's scanner.
std::size_t read_scans(sim::Recording& recording, const std::string& name, const ScanChoice& choice,
                       ScanTable& table);

}  // namespace scipd::tools
