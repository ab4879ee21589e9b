// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tests/end_to_end/mrpt_driver.h"

#include <stdexcept>
#include <utility>

#include <gtest/gtest.h>

namespace scipd::tests {

MrptDriver::MrptDriver(const DaemonProcess& daemon, Link link, std::size_t sensor, bool intensity) {
    if (link == Link::tcp) {
        urg_.setIPandPort("127.0.0.1", daemon.port(sensor));
    } else {
        urg_.setSerialPort(daemon.tty(sensor));
    }
    begin(intensity);
}

MrptDriver::MrptDriver(std::uint16_t port) {
    urg_.setIPandPort("127.0.0.1", port);
    begin(false);
}

MrptDriver::MrptDriver(const std::filesystem::path& tty) {
    urg_.setSerialPort(tty);
    begin(false);
}

void MrptDriver::begin(bool intensity) {
    urg_.setVerbosityLevel(mrpt::system::LVL_ERROR);
    urg_.setIntensityMode(intensity);
    // It is private in CHokuyoURG but public in its base.
    static_cast<mrpt::hwdrivers::CGenericSensor&>(urg_).initialize();
}

MrptDriver::Look MrptDriver::look() {
    Look look;
    Scan scan;
    bool there = false;
    try {
        urg_.doProcessSimple(there, scan, look.failed);
    } catch (const std::exception&) {
        look.failed = true;
    }
    if (there) look.scan = std::move(scan);
    return look;
}

MrptDriver::Scan MrptDriver::next_scan() {
    Scan scan;
    // A call that gets no scan takes 100 ms.
    for (int attempt = 0; attempt < 50; ++attempt) {
        bool there = false;
        bool failed = false;
        urg_.doProcessSimple(there, scan, failed);
        if (failed) throw std::runtime_error("the driver reports an error of the hardware");
        if (there) return scan;
    }
    throw std::runtime_error("the driver sees no scans");
}

void expect_shape(const MrptDriver::Scan& scan, const Product& product) {
    ASSERT_EQ(scan.getScanSize(), static_cast<std::size_t>(product.beams()));
    EXPECT_TRUE(scan.rightToLeft);
    EXPECT_NEAR(scan.aperture, product.beams() * product.step_rad(), 1.01 * product.step_rad());
    EXPECT_FLOAT_EQ(scan.maxRange, static_cast<float>(product.farthest_m));
}

int expect_room(const MrptDriver::Scan& scan, const Product& product, const Planar& scanner) {
    int compared = 0;
    for (int beam = 0; beam < product.beams(); ++beam) {
        const auto truth_m = certain_range_in_square_room(scanner, product.bearing_rad(beam));
        if (!truth_m) continue;
        ++compared;
        EXPECT_TRUE(scan.getScanRangeValidity(beam)) << "beam " << beam;
        EXPECT_NEAR(scan.getScanRange(beam), *truth_m, tolerance_m) << "beam " << beam;
    }
    return compared;
}

}  // namespace scipd::tests
