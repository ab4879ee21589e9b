// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a test tells its scipd and hears of it: poses, scans, what is true, errors. Values; no
// thread rule.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace scipd::testing {

using Json = nlohmann::ordered_json;

/// Where a robot or a model is: metres and radians; x forward, y left, z up.
struct Pose {
    Pose() = default;
    Pose(double x, double y, double yaw) : x_m(x), y_m(y), yaw_rad(yaw) {}
    Pose(double x, double y, double z, double roll, double pitch, double yaw)
        : x_m(x), y_m(y), z_m(z), roll_rad(roll), pitch_rad(pitch), yaw_rad(yaw) {}

    double x_m = 0;
    double y_m = 0;
    double z_m = 0;
    double roll_rad = 0;
    double pitch_rad = 0;
    double yaw_rad = 0;
};

/// One beam.
struct Seen {
    double range_m = 0;
    double angle_rad = 0;  ///< 0 is ahead, counter-clockwise is positive
    // Only the truth has these.
    std::string object;  ///< MODEL::LINK::VISUAL
    std::string material;
};

/// What a scanner has sent. Each list has an element for each step.
struct Scan {
    std::string sensor;                           ///< ROBOT/SENSOR
    std::vector<std::optional<double>> ranges_m;  ///< nothing: the scanner has sent a code
    std::vector<std::uint32_t> intensities;       ///< empty: the model has none
    std::vector<double> angles_rad;
    std::vector<std::uint32_t> sent_mm;  ///< the ranges with the codes
    std::uint32_t stamp_ms = 0;          ///< the scanner's clock, 24 bits

    /// The range of the beam nearest to this direction. Throws std::out_of_range where the scanner
    /// does not look.
    [[nodiscard]] std::optional<double> at(double angle_rad) const;
    /// Nothing: it has no range at all.
    [[nodiscard]] std::optional<Seen> nearest() const;
};

/// What was true of a scan. Each list has an element for each step.
struct Truth {
    std::string sensor;
    std::vector<std::optional<double>> ranges_m;  ///< nothing: the beam met nothing
    std::vector<std::string> objects;             ///< MODEL::LINK::VISUAL; empty: nothing
    std::vector<std::string> materials;
    std::vector<double> angles_rad;  ///< empty for cameras and rangers
    double time_s = 0;
    Json raw;  ///< all of it, as the control API tells it

    /// What the beam nearest to this direction met. Throws as Scan::at() does.
    [[nodiscard]] std::optional<Seen> at(double angle_rad) const;
    [[nodiscard]] std::optional<Seen> nearest() const;
};

/// What went wrong, as a sentence for whoever reads the report of a test.
class ScipdError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// There is no program scipd.
class ScipdNotFound : public ScipdError {
  public:
    using ScipdError::ScipdError;
};

/// scipd ended before it was ready, or took too long. The sentence has the end of its log.
class ScipdNotReady : public ScipdError {
  public:
    using ScipdError::ScipdError;
};

/// scipd is not there any more: it crashed, somebody killed it, or it was closed.
class ScipdEnded : public ScipdError {
  public:
    using ScipdError::ScipdError;
};

/// A scanner sent no scan in time, or none that is whole.
class NoScan : public ScipdError {
  public:
    using ScipdError::ScipdError;
};

/// In lockstep, time did not go on.
class TimeStandsStill : public ScipdError {
  public:
    using ScipdError::ScipdError;
};

/// scipd refused a request of the control API.
class Refused : public ScipdError {
  public:
    Refused(int status, const std::string& sentence) : ScipdError(sentence), status_(status) {}

    [[nodiscard]] int status() const { return status_; }

  private:
    int status_;
};

}  // namespace scipd::testing
