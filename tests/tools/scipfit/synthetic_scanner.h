// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// ScanTable of scanners whose errors are known: scipd's own sensor model in rooms of boxes, without
// a daemon.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "daemon/models/model.h"
#include "sim/sensor/scanner.h"
#include "tools/analysis/scan_table.h"

namespace scipd::tests {

/// A room of W, around its origin, with walls of four materials.
struct Room {
    double length_m = 6.0;
    double width_m = 4.0;
    /// Things that stand in it: where, and half their sides.
    struct Thing {
        double x_m, y_m, half_m;
    };
    std::vector<Thing> things;
    std::vector<double> reflectances = {0.9, 0.7, 0.5, 0.3};  ///< of the walls, then of all things
};

[[nodiscard]] sim::SharedScene scene_of(const Room& room);

struct Place {
    double x_m = 0.0;
    double y_m = 0.0;
    double yaw_rad = 0.0;
};

class SyntheticScanner {
  public:
    /// At Accuracy::material where its light is known, else at Accuracy::sensor.
    SyntheticScanner(daemon::Model model, const Room& room, bool with_light, std::uint64_t seed);

    /// At any accuracy.
    void tell_intensities() { tells_intensities_ = true; }

    /// Adds scans from this place.
    void stand(const Place& place, int scans, tools::ScanTable& readings);

    /// ScanTable of it, without scans.
    [[nodiscard]] tools::ScanTable begin() const;

  private:
    daemon::Model model_;
    bool with_light_;
    bool tells_intensities_ = with_light_;
    sim::Scanner scanner_;
    sim::SharedLitWorld lit_;
    std::unique_ptr<sim::RangeBackend> backend_;
    std::int64_t revolution_ = 0;
};

/// Closes a recording: what follows is another one.
void end_recording(tools::ScanTable& readings);

/// Only what these steps see is left.
[[nodiscard]] tools::ScanTable only(tools::ScanTable readings, std::size_t first, std::size_t last);

}  // namespace scipd::tests
