// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A driver that others wrote, MRPT's CHokuyoURG as Debian ships it, and what it must see of
// scenes/square_room.sdf through a scanner with a known data sheet.
#pragma once

#include <cstdint>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>

#include <mrpt/hwdrivers/CHokuyoURG.h>
#include <mrpt/obs/CObservation2DRangeScan.h>

#include "tests/end_to_end/square_room.h"
#include "tests/support/daemon_process.h"

namespace scipd::tests {

/// From the data sheets.
struct Product {
    const char* name;
    int steps_per_turn;
    int first_step;
    int last_step;
    int front_step;
    double farthest_m;
    double period_s;

    [[nodiscard]] int beams() const { return last_step - first_step + 1; }
    [[nodiscard]] double step_rad() const { return 2.0 * std::numbers::pi / steps_per_turn; }
    /// MRPT counts beams from right to left.
    [[nodiscard]] double bearing_rad(int beam) const {
        return (first_step + beam - front_step) * step_rad();
    }
};

inline constexpr Product urg_04lx{"URG-04LX", 1024, 44, 725, 384, 5.6, 0.1};
inline constexpr Product utm_30lx{"UTM-30LX", 1440, 0, 1080, 540, 60.0, 0.025};
inline constexpr Product ust_10lx{"UST-10LX", 1440, 0, 1080, 540, 30.0, 0.025};
inline constexpr Product ust_20lx{"UST-20LX", 1440, 0, 1080, 540, 60.0, 0.025};

enum class Link { tcp, tty };

// The scanner's unit accounts for half a millimetre.
inline constexpr double tolerance_m = 0.0015;

class MrptDriver {
  public:
    using Scan = mrpt::obs::CObservation2DRangeScan;

    /// With `intensity` it asks for that too.
    MrptDriver(const DaemonProcess& daemon, Link link, std::size_t sensor = 0,
               bool intensity = false);

    /// Drives the scanner at this place: a port of 127.0.0.1, or a tty.
    explicit MrptDriver(std::uint16_t port);
    explicit MrptDriver(const std::filesystem::path& tty);

    /// What one call of the driver says.
    struct Look {
        std::optional<Scan> scan;
        bool failed = false;  ///< it reports an error of the hardware, or throws
    };
    /// A call that gets no scan takes up to 100 ms, and longer where it connects anew.
    [[nodiscard]] Look look();

    /// Throws std::runtime_error if no scan comes for some seconds.
    [[nodiscard]] Scan next_scan();

  private:
    void begin(bool intensity);

    mrpt::hwdrivers::CHokuyoURG urg_;
};

void expect_shape(const MrptDriver::Scan& scan, const Product& product);

/// Returns how many beams it has compared.
int expect_room(const MrptDriver::Scan& scan, const Product& product, const Planar& scanner);

}  // namespace scipd::tests
