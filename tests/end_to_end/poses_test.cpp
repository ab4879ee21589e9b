// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Robots that are moved from outside, by all means that scipd offers, and what their scans see
// then.
#include <chrono>
#include <string>

#include <gtest/gtest.h>

#include "tests/end_to_end/in_square_room.h"
#include "tests/support/child.h"
#include "tests/support/udp_sender.h"

namespace scipd::tests {
namespace {

using namespace std::chrono_literals;

/// A scanner with a stream of the beam that looks ahead.
class Ahead {
  public:
    explicit Ahead(const DaemonProcess& daemon) : wire_(ScannerWire::tcp(daemon.port())) {
        EXPECT_EQ(wire_.ask(stream_of_one_beam), "00");
    }

    unsigned distance_mm() { return wire_.next_scan().distances_mm.front(); }

    /// Whether it sees this distance within 10 s.
    bool comes_to_see(unsigned wanted_mm) {
        for (int i = 0; i < 400; ++i) {
            if (distance_mm() == wanted_mm) return true;
        }
        return false;
    }

  private:
    ScannerWire wire_;
};

Arguments with_poses(const std::string& source) {
    return on_tcp({"--accuracy", "ideal", "--poses", source});
}

class Poses : public testing::Test {
  protected:
    TempDir directory_;
};

TEST_F(Poses, ComeByUdpAndAreCountedWhereDamaged) {
    const UdpSender sender;
    const DaemonProcess daemon(directory_,
                               with_poses("udp:127.0.0.1:" + std::to_string(sender.port())));
    Ahead ahead(daemon);
    EXPECT_TRUE(ahead.comes_to_see(3000));

    sender.send(R"({"xyz":[1,0,0]})");
    EXPECT_TRUE(ahead.comes_to_see(2000));
    // It turns left, to the wall at y = 2. This line uses the other form and names no robot.
    sender.send("1000.5 0 0.5 0 0 0 0.7071067811865476 0.7071067811865476\n");
    EXPECT_TRUE(ahead.comes_to_see(1500));

    for (const char* damaged : {"{\"xyz\":[2,0,0]", "nonsense", "{\"xyz\":[2,0,null]}",
                                "{\"robot\":\"nobody\",\"xyz\":[2,0,0]}"})
        sender.send(damaged);
    ASSERT_TRUE(eventually([&] { return daemon.get("/status").at("poses").at("refused") == 4; }));
    const auto poses = daemon.get("/status").at("poses");
    EXPECT_EQ(poses.at("accepted"), 2);
    EXPECT_EQ(poses.at("last_refusal"), "robot: there is no \"nobody\"; robots are robot");
    // The last valid pose holds.
    EXPECT_EQ(ahead.distance_mm(), 1500U);
}

TEST_F(Poses, ComeByStandardInput) {
    const DaemonProcess daemon(directory_, with_poses("-"));
    Ahead ahead(daemon);
    daemon.say(R"({"robot":"robot","xyz":[1,0,0],"q":[0,0,0,1]})");
    daemon.say("\n");
    EXPECT_TRUE(ahead.comes_to_see(2000));
    // A line may come in pieces.
    daemon.say("{\"xyz\":[2");
    std::this_thread::sleep_for(100ms);
    daemon.say(",0,0]}\n");
    EXPECT_TRUE(ahead.comes_to_see(1000));
}

TEST_F(Poses, ComeFromATrajectoryInItsOwnTime) {
    const auto file = directory_.write("drive.tum",
                                       "100.0 0.0 0 0 0 0 0 1\n"
                                       "100.8 0.8 0 0 0 0 0 1\n"
                                       "101.2 1.2 0 0 0 0 0 1\n"
                                       "102.0 2.0 0 0 0 0 0 1\n");
    const DaemonProcess daemon(directory_, with_poses(file));
    Ahead ahead(daemon);
    // At 1 m/s a scan is 25 mm from the one before.
    unsigned last_mm = ahead.distance_mm();
    int steps = 0;
    while (last_mm > 1000) {
        const unsigned next_mm = ahead.distance_mm();
        ASSERT_LE(next_mm, last_mm);
        if (last_mm < 3000 && next_mm > 1000) {
            EXPECT_NEAR(last_mm - next_mm, 25, 1);
            ++steps;
        }
        last_mm = next_mm;
    }
    EXPECT_GT(steps, 5);
    EXPECT_EQ(ahead.distance_mm(), 1000U);
}

TEST_F(Poses, ComeFromScipctl) {
    const DaemonProcess daemon(directory_, on_tcp());
    const auto scipctl = [&](Arguments command, const std::string& input = {}) {
        command.insert(command.begin(), {SCIPCTL, "--control", daemon.control()});
        const Outcome outcome = run(command, input);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return outcome.out;
    };
    Ahead ahead(daemon);
    scipctl({"pose", "set", "1,0,0"});
    EXPECT_TRUE(ahead.comes_to_see(2000));
    EXPECT_EQ(scipctl({"pose", "get"}).substr(0, 4), "1,0,");

    scipctl({"pose", "stream"}, "{\"xyz\":[-1,0,0]}\n{\"xyz\":[0.5,0,0]}\n");
    EXPECT_TRUE(ahead.comes_to_see(2500));

    const auto file = directory_.write("drive.tum", "7 0 0 0 0 0 0 1\n7.2 2 0 0 0 0 0 1\n");
    scipctl({"pose", "play", file});
    EXPECT_TRUE(ahead.comes_to_see(1000));

    const std::string status = scipctl({"status"});
    EXPECT_NE(status.find("robot/scanner"), std::string::npos);
    EXPECT_NE(status.find("5 accepted, 0 refused"), std::string::npos) << status;
    EXPECT_EQ(nlohmann::json::parse(scipctl({"sensors", "--json"})).at(0).at("model"), "UST-10LX");
}

}  // namespace
}  // namespace scipd::tests
