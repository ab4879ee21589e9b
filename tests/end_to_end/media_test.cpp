// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Fog that comes and goes while a client reads scans of a square room, whose walls ahead and behind
// are 3 m away.
#include <algorithm>
#include <csignal>
#include <cstdint>
#include <functional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/end_to_end/in_square_room.h"
#include "tests/support/control_request.h"

namespace scipd::tests {
namespace {

using nlohmann::json;
using protocol::client::ScanMessage;
using testing::HasSubstr;

class Media : public testing::Test {
  protected:
    /// Writes the configuration, always to the same file.
    static std::string write(const TempDir& directory, const std::string& media,
                             const std::string& accuracy = "material") {
        return directory.write(
            "rig.yaml", "scene: " + scene("square_room.sdf").string() + "\n" + media +
                            "robots: {r: {sensors: {s: {model: UTM-30LX, mount: {xyz: [0, 0, "
                            "0.3]}, tcp: \"127.0.0.1:0\", accuracy: " +
                            accuracy + "}}}}\n");
    }

    static ControlAnswer ask(const DaemonProcess& daemon, const std::string& method,
                             const std::string& body = {}) {
        return control_request(daemon.control(), method, "/scene/media", body);
    }

    static bool says(const DaemonProcess& daemon, const std::string& words, std::size_t times = 1) {
        return eventually([&] {
            const std::string log = daemon.standard_error();
            std::size_t count = 0;
            for (auto at = log.find(words); at != log.npos; at = log.find(words, at + 1))
                ++count;
            return count >= times;
        });
    }

    const TempDir directory_;
};

/// How many of 101 beams around the one that looks there measure the wall in 3 m, give or take what
/// an oblique beam and noise add.
long see_the_wall(const ScanMessage& scan) {
    return std::ranges::count_if(scan.distances_mm, [](std::uint32_t distance_mm) {
        return distance_mm > 2850 && distance_mm < 3250;
    });
}

/// Reads scans until one is as wanted; those from before a change come first.
bool becomes(ScannerWire& wire, const std::function<bool(const ScanMessage&)>& wanted) {
    for (int i = 0; i < 400; ++i) {
        if (wanted(wire.next_scan())) return true;
    }
    return false;
}

bool sees_all(const ScanMessage& scan) {
    return see_the_wall(scan) > 98;
}

const std::string stream_ahead = "MD0490059000000";

TEST_F(Media, HideTheWallWhileTheyAreThere) {
    const DaemonProcess daemon(directory_, {"--config", write(directory_, "")});
    ASSERT_NE(daemon.ready_line(), "") << daemon.standard_error();
    ScannerWire wire = ScannerWire::tcp(daemon.port());
    ASSERT_EQ(wire.ask(stream_ahead), "00");
    EXPECT_TRUE(becomes(wire, sees_all));

    // A wall 3 m away gives back exp(-2 * 3.912 / 0.5 * 3) = 4e-21 of the light: nobody sees it.
    // What comes back at all comes from the fog, and so from nearer.
    const ControlAnswer fog = ask(daemon, "PUT", R"([{"kind":"fog","visibility_m":0.5}])");
    EXPECT_EQ(fog.status, 200) << fog.body;
    EXPECT_EQ(json::parse(fog.body), json::parse(R"({"warnings":[]})"));
    EXPECT_TRUE(becomes(wire, [](const ScanMessage& scan) { return see_the_wall(scan) == 0; }));
    for (int i = 0; i < 20; ++i) {
        const ScanMessage scan = wire.next_scan();
        EXPECT_EQ(see_the_wall(scan), 0);
        EXPECT_LT(*std::ranges::max_element(scan.distances_mm), 2850U);
    }

    EXPECT_EQ(ask(daemon, "DELETE").status, 204);
    EXPECT_TRUE(becomes(wire, sees_all));
    EXPECT_EQ(wire.ask("QT"), "00");
}

TEST_F(Media, FillTheirBoxAndNoMore) {
    // Smoke that sends nothing back fills the room from 1 m ahead of the scanner on.
    const DaemonProcess daemon(
        directory_, {"--config", write(directory_,
                                       "media: [{kind: custom, name: smoke, extinction_per_m: 20, "
                                       "box: {from: [1, -2, 0], to: [3, 2, 2]}}]\n")});
    ASSERT_NE(daemon.ready_line(), "") << daemon.standard_error();
    ScannerWire wire = ScannerWire::tcp(daemon.port());
    ASSERT_EQ(wire.ask("MD0000108000000"), "00");
    for (int i = 0; i < 5; ++i) {
        const ScanMessage scan = wire.next_scan();
        const auto& all = scan.distances_mm;
        ASSERT_EQ(all.size(), 1081U);
        for (std::size_t step = 490; step <= 590; ++step)
            ASSERT_LT(all[step], 23U) << step;
        // To the left and right the walls are 2 m away, and the smoke begins further ahead.
        EXPECT_NEAR(all[180], 2000, 150);
        EXPECT_NEAR(all[900], 2000, 150);
    }
}

TEST_F(Media, StayOverAReloadThatSaysTheSameOfThem) {
    const std::string mist = "media: [{kind: fog, visibility_m: 30, name: mist}]\n";
    const DaemonProcess daemon(directory_, {"--config", write(directory_, mist)});
    ASSERT_NE(daemon.ready_line(), "") << daemon.standard_error();
    EXPECT_EQ(json::parse(ask(daemon, "GET").body),
              json::parse(R"([{"kind":"fog","name":"mist","visibility_m":30.0}])"));

    EXPECT_EQ(ask(daemon, "PUT", R"([{"kind":"snow","mm_per_hour":2}])").status, 200);
    const json snow = json::parse(R"([{"kind":"snow","name":"snow","mm_per_hour":2.0}])");
    daemon.signal(SIGHUP);
    ASSERT_TRUE(says(daemon, "is running now", 1)) << daemon.standard_error();
    EXPECT_EQ(json::parse(ask(daemon, "GET").body), snow);

    write(directory_, "media: [{kind: rain, mm_per_hour: 900}]\n");
    daemon.signal(SIGHUP);
    ASSERT_TRUE(says(daemon, "nothing was changed")) << daemon.standard_error();
    EXPECT_THAT(daemon.standard_error(), HasSubstr(":2: media.mm_per_hour: must be 0 to 500"));
    EXPECT_EQ(json::parse(ask(daemon, "GET").body), snow);

    write(directory_, "media: [{kind: rain, mm_per_hour: 9}]\n");
    daemon.signal(SIGHUP);
    ASSERT_TRUE(says(daemon, "is running now", 2)) << daemon.standard_error();
    EXPECT_EQ(json::parse(ask(daemon, "GET").body),
              json::parse(R"([{"kind":"rain","name":"rain","mm_per_hour":9.0}])"));

    write(directory_, "");
    daemon.signal(SIGHUP);
    ASSERT_TRUE(says(daemon, "is running now", 3)) << daemon.standard_error();
    EXPECT_EQ(ask(daemon, "GET").body, "[]\n");
}

TEST_F(Media, SaySoWhereNoScannerSeesThem) {
    const std::string file = write(directory_, "media: [{kind: rain, mm_per_hour: 9}]\n", "sensor");
    const DaemonProcess daemon(directory_, {"--config", file});
    ASSERT_NE(daemon.ready_line(), "") << daemon.standard_error();
    const std::string unseen =
        "no scanner has accuracy: material, so what fills the air changes no scan";
    EXPECT_TRUE(says(daemon, file + ":2: media: " + unseen)) << daemon.standard_error();
    const ControlAnswer put = ask(daemon, "PUT", R"([{"kind":"snow","mm_per_hour":2}])");
    EXPECT_EQ(json::parse(put.body)["notes"], json::array({unseen}));
    const ControlAnswer cleared = ask(daemon, "PUT", "[]");
    EXPECT_FALSE(json::parse(cleared.body).contains("notes"));
}

// Most worlds define materials, and most scanners see none: that is nothing to read at each start.
TEST(Materials, ThatNoScannerSeesAreNotedAtDebug) {
    const auto log_at = [](const std::string& level) {
        const TempDir directory;
        DaemonProcess daemon(directory, {"--free-ports", "--log-level", level});
        EXPECT_NE(daemon.ready_line(), "") << daemon.standard_error();
        daemon.signal(SIGTERM);
        EXPECT_EQ(daemon.wait(), 0);
        return daemon.standard_error();
    };
    const std::string notice = ", but they have no effect: no scanner uses `accuracy: material`";
    EXPECT_THAT(log_at("info"), testing::Not(HasSubstr(notice)));
    EXPECT_THAT(log_at("debug"), HasSubstr(notice));
}

}  // namespace
}  // namespace scipd::tests
