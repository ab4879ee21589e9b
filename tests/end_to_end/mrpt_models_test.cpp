// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// MRPT's driver sees the room through every model, over TCP and over the tty, in whatever state it
// finds the scanner.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <exception>
#include <functional>
#include <future>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "tests/end_to_end/mrpt_driver.h"
#include "tests/support/scanner_wire.h"

namespace scipd::tests {
namespace {

constexpr Product products[] = {
    {"URG-04LX@3.1.04", 1024, 44, 725, 384, 5.6, 0.1},
    {"URG-04LX@3.3.00", 1024, 44, 725, 384, 5.6, 0.1},
    {"URG-04LX-UG01", 1024, 44, 725, 384, 5.6, 0.1},
    {"UBG-04LX-F01", 1024, 44, 725, 384, 5.6, 0.028},
    {"UHG-08LX", 1024, 0, 768, 384, 11.0, 0.067},
    {"UTM-30LX", 1440, 0, 1080, 540, 60.0, 0.025},
    {"UTM-30LX-EW", 1440, 0, 1080, 540, 60.0, 0.025},
    {"UXM-30LX-E", 1440, 0, 760, 380, 100.0, 0.05},
    {"UXM-30LX-EW", 1440, 0, 760, 380, 100.0, 0.05},
    {"UXM-30LXH-EWA", 2880, 0, 1520, 760, 80.0, 0.05},
    {"UST-05LX", 720, 0, 540, 270, 15.0, 0.025},
    {"UST-10LX", 1440, 0, 1080, 540, 30.0, 0.025},
    {"UST-10LX-H01", 2880, 0, 2160, 1080, 30.0, 0.025},
    {"UST-10LX-H02", 2880, 0, 2160, 1080, 30.0, 0.025},
    {"UST-20LX", 1440, 0, 1080, 540, 60.0, 0.025},
    {"UST-20LX-H01", 2880, 0, 2160, 1080, 60.0, 0.025},
    {"UST-30LX", 1440, 0, 1080, 540, 60.0, 0.025},
    {"UST-30LC@1.0.1", 1440, 0, 1080, 540, 60.0, 0.025},
    {"UST-30LC@4.0.2-A", 1440, 0, 1080, 540, 60.0, 0.025},
    {"UST-30LC@4.0.3", 1440, 0, 1080, 540, 60.0, 0.025},
    {"UST-30LC@4.1.0b-A", 1440, 0, 1080, 540, 60.0, 0.025},
};

/// Answers once in 100 ms, which over TCP is as long as MRPT waits. Real ones have no Ethernet.
bool too_slow_for_tcp(const Product& product) {
    const std::string_view name = product.name;
    return name.starts_with("URG-04LX") || name == "UXM-30LX-E";
}

constexpr Planar robot{-1.2, 0.7, 2.2};

struct Carried {
    Product product;
    Link link;
};

std::vector<Carried> carried(std::span<const Product> products_of, std::vector<Link> links) {
    std::vector<Carried> all;
    for (const Link link : links) {
        for (const Product& product : products_of)
            all.push_back({product, link});
    }
    return all;
}

/// A robot that carries these scanners, all with these keys.
std::string configuration(std::span<const Carried> scanners, const std::string& keys) {
    std::string text = "scene: " + scene("square_room.sdf").string() +
                       "\nrobots:\n  robot:\n    pose: {xyz: [-1.2, 0.7, 0], rpy: [0, 0, 2.2]}\n"
                       "    sensors:\n";
    for (const Carried& scanner : scanners) {
        const auto& [product, link] = scanner;
        const bool ideal = link == Link::tcp && too_slow_for_tcp(product);
        text += "      s" + std::to_string(&scanner - scanners.data()) +
                ": {model: " + product.name + ", mount: {xyz: [0, 0, 0.3]}, accuracy: ideal, " +
                (link == Link::tcp ? "tcp: 127.0.0.1:0" : "pty: auto") +
                (ideal ? ", timing: ideal" : "") + keys + "}\n";
    }
    return text;
}

/// Checks that a scan comes and is right. Restarts a driver that gives up, as its user would, until
/// `patience` is over.
void expect_room_seen(const DaemonProcess& daemon, std::size_t sensor, const Carried& scanner,
                      std::chrono::seconds patience) {
    const auto& [product, link] = scanner;
    SCOPED_TRACE(product.name);
    const auto until = std::chrono::steady_clock::now() + patience;
    for (;;) {
        try {
            MrptDriver driver(daemon, link, sensor);
            const MrptDriver::Scan scan = driver.next_scan();
            expect_shape(scan, product);
            EXPECT_GT(expect_room(scan, product, robot), product.beams() * 95 / 100);
            return;
        } catch (const std::exception& error) {
            if (std::chrono::steady_clock::now() < until) continue;
            ADD_FAILURE() << error.what();
            return;
        }
    }
}

using Before = std::function<void(const DaemonProcess& daemon, std::size_t sensor, Link link)>;

// MRPT sleeps most of the time, so that several drivers at once take no longer than one.
void expect_room_seen_by_all(const std::vector<Carried>& scanners, const std::string& keys = "",
                             const Before& before = {},
                             std::chrono::seconds patience = std::chrono::seconds(20)) {
    const TempDir directory;
    const auto file = directory.write("rig.yaml", configuration(scanners, keys));
    const DaemonProcess daemon(directory, {"--config", file});
    ASSERT_NE(daemon.ready_line(), "") << daemon.standard_error();
    // A driver reads a stream that runs already without a pause. On a slow machine, more than a few
    // of them keep each other from an answer within the 100 ms that MRPT waits for it.
    const std::size_t at_once = before ? 4 : 16;
    for (std::size_t first = 0; first < scanners.size(); first += at_once) {
        std::vector<std::future<void>> drivers;
        for (std::size_t i = first; i < std::min(first + at_once, scanners.size()); ++i) {
            if (before) before(daemon, i, scanners[i].link);
            drivers.push_back(std::async(std::launch::async, [&, i] {
                expect_room_seen(daemon, i, scanners[i], patience);
            }));
        }
    }
}

/// One model for each timing and each set of commands.
constexpr Product families[] = {products[1], products[2], products[5],  products[6],
                                products[7], products[9], products[11], products[18]};

TEST(MrptDriverOnEveryModel, SeesTheRoomOverTcp) {
    expect_room_seen_by_all(carried(products, {Link::tcp}));
}

TEST(MrptDriverOnEveryModel, SeesTheRoomOverTheTty) {
    expect_room_seen_by_all(carried(products, {Link::tty}));
}

// A UST takes 10 s to boot. MRPT gives up several times meanwhile.
TEST(MrptDriverFromAColdBoot, SeesTheRoom) {
    expect_room_seen_by_all(carried(families, {Link::tcp, Link::tty}), ", power_up: boot", {},
                            std::chrono::seconds(40));
}

void left_streaming(const DaemonProcess& daemon, std::size_t sensor, Link) {
    auto earlier = ScannerWire::tty(daemon.tty(sensor));
    ASSERT_EQ(earlier.ask("MD0100020001000"), "00");
    (void)earlier.next_scan();
}

void left_adjusting(const DaemonProcess& daemon, std::size_t sensor, Link link) {
    auto earlier = link == Link::tcp ? ScannerWire::tcp(daemon.port(sensor))
                                     : ScannerWire::tty(daemon.tty(sensor));
    ASSERT_EQ(earlier.ask("TM0"), "00");
}

// The earlier client closes the tty, and its stream goes on.
TEST(MrptDriverAfterAnotherClient, SeesTheRoomThroughAStreamThatRuns) {
    expect_room_seen_by_all(carried(families, {Link::tty}), ", link: {on_close: keep}",
                            left_streaming);
}

// The adjust mode ends with its client.
TEST(MrptDriverAfterAnotherClient, SeesTheRoomAfterTimeAdjust) {
    expect_room_seen_by_all(carried(families, {Link::tcp, Link::tty}), "", left_adjusting);
}

// On a tty that keeps adjust mode, MRPT reaches only models that leave it by QT, because MRPT does
// not send TM2.
TEST(MrptDriverAfterAnotherClient, SeesTheRoomThroughAnAdjustModeThatIsKept) {
    const Product leaves_by_qt[] = {products[6], products[8], products[9]};
    expect_room_seen_by_all(carried(leaves_by_qt, {Link::tty}), ", link: {on_close: keep}",
                            left_adjusting);
}

TEST(MrptDriverFromScip1, SeesTheRoom) {
    const Product old[] = {products[0], products[1]};
    expect_room_seen_by_all(carried(old, {Link::tcp, Link::tty}), ", power_up: scip1.1");
}

}  // namespace
}  // namespace scipd::tests
