// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Time is that of the poses' stamps. Two runs give the same bytes, whoever reads them and however
// slowly.
#include <array>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/end_to_end/in_square_room.h"
#include "tests/support/control_request.h"
#include "tests/support/daemon_process.h"
#include "tests/support/scanner_wire.h"

namespace scipd::tests {
namespace {

using namespace std::chrono_literals;

constexpr int poses_per_s = 50;

/// A drive in circles of 1 m. Its stamps count from 1970, or from `first_s`.
std::string pose_line(int i, double first_s = 1.7e9) {
    const double t_s = static_cast<double>(i) / poses_per_s;
    std::array<char, 160> line;
    const int length = std::snprintf(
        line.data(), line.size(), "{\"t\":%.3f,\"xyz\":[%.6f,%.6f,0],\"rpy\":[0,0,%.6f]}\n",
        first_s + t_s, std::cos(t_s) - 1.0, std::sin(t_s), std::remainder(t_s + 1.5, 6.283185307));
    return {line.data(), static_cast<std::size_t>(length)};
}

/// FNV-1a.
class Digest {
  public:
    void add(std::string_view bytes) {
        for (const char c : bytes)
            value_ = (value_ ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
    }
    [[nodiscard]] std::uint64_t value() const { return value_; }

  private:
    std::uint64_t value_ = 14695981039346656037ULL;
};

std::vector<std::string> in_lockstep(std::string_view world = "square_room.sdf") {
    return {"--scene", scene(world).string(), "--pty",  "auto", "--clock", "poses", "--poses", "-",
            "--tcp",   "127.0.0.1:0",         "--seed", "7"};
}

/// Reads all that a stream sends until the poses end.
class Reader {
  public:
    Reader(ScannerWire wire, int pause_every) : wire_(std::move(wire)), pause_every_(pause_every) {
        EXPECT_EQ(wire_.ask("MD0000108001000"), "00");
    }

    void read(int scans) {
        std::array<char, 65536> buffer;
        for (int reads = 1; scans_ < scans; ++reads) {
            const std::size_t count = wire_.read(buffer, ScannerWire::patience);
            if (count == 0) break;
            take({buffer.data(), count}, scans);
            if (pause_every_ > 0 && reads % pause_every_ == 0) std::this_thread::sleep_for(2ms);
        }
    }

    [[nodiscard]] std::uint64_t digest() const { return digest_.value(); }
    [[nodiscard]] int scans() const { return scans_; }

  private:
    // Messages end with an empty line. Bytes after the last message that counts are dropped.
    void take(std::string_view bytes, int scans) {
        std::size_t end = 0;
        for (std::size_t i = 0; i < bytes.size() && scans_ < scans; ++i) {
            if (bytes[i] == '\n' && last_ == '\n') ++scans_;
            last_ = bytes[i];
            end = i + 1;
        }
        digest_.add(bytes.substr(0, end));
    }

    ScannerWire wire_;
    int pause_every_;
    Digest digest_;
    int scans_ = 0;
    char last_ = '\0';
};

struct Drive {
    std::uint64_t digest;
    double time_s;
    std::uint64_t lost;
};

Drive drive(int simulated_s, int pause_every, bool company,
            const std::function<std::string(int)>& line,
            std::string_view world = "square_room.sdf") {
    const TempDir directory;
    const DaemonProcess daemon(directory, in_lockstep(world));
    Reader reader(ScannerWire::tcp(daemon.port(), pause_every > 0 ? 4096 : 0), pause_every);
    std::optional<ScannerWire> other;
    if (company) {
        other.emplace(ScannerWire::tty(daemon.tty()));
        EXPECT_EQ(other->ask("VV"), "00");
    }
    std::thread sender([&] {
        std::string lines;
        for (int i = 0; i <= simulated_s * poses_per_s; ++i) {
            lines += line(i);
            if (i % 40 == 0) daemon.say(std::exchange(lines, {}));
        }
        daemon.say(lines);
    });
    // The poses may end before the last turns do.
    const int scans = simulated_s * 39;
    reader.read(scans);
    sender.join();
    EXPECT_EQ(reader.scans(), scans);
    const auto status = daemon.get("/status");
    EXPECT_EQ(status.at("clock"), "poses");
    return {reader.digest(), status.at("time_s"), daemon.sensor_status().at("lost")};
}

TEST(InLockstep, TenMinutesGiveTheSameBytesToAQuickAndToASlowReader) {
    constexpr int simulated_s = 600;
    const auto line = [](int i) { return pose_line(i); };
    const Drive quick = drive(simulated_s, 0, false, line);
    const Drive slow = drive(simulated_s, 3, true, line);
    EXPECT_EQ(quick.digest, slow.digest);
    EXPECT_EQ(quick.lost, 0U);
    EXPECT_EQ(slow.lost, 0U);
    EXPECT_NEAR(quick.time_s, 1.7e9 + simulated_s, 0.5 * simulated_s);
}

// One stamp in between is damaged, and half-way the stamps start again from 0.
TEST(InLockstep, ASimulatorThatIsStartedAgainGivesTheSameBytesToAllReaders) {
    constexpr int simulated_s = 60;
    const auto line = [](int i) {
        constexpr int half = simulated_s * poses_per_s / 2;
        if (i == half / 2) return pose_line(i, 1e6);
        return i <= half ? pose_line(i) : pose_line(i - half - 1, 0.0);
    };
    const Drive quick = drive(simulated_s, 0, false, line);
    const Drive slow = drive(simulated_s, 3, true, line);
    EXPECT_EQ(quick.digest, slow.digest);
    EXPECT_EQ(quick.lost, 0U);
    EXPECT_LE(quick.time_s, simulated_s / 2.0);
    EXPECT_GE(quick.time_s, simulated_s / 2.0 - 3.0);
}

TEST(InLockstep, PeopleWhoWalkGiveTheSameBytesToAllReaders) {
    constexpr int simulated_s = 30;
    const auto line = [](int i) { return pose_line(i); };
    const Drive quick = drive(simulated_s, 0, false, line, "crossing.sdf");
    const Drive slow = drive(simulated_s, 3, true, line, "crossing.sdf");
    EXPECT_EQ(quick.digest, slow.digest);
    EXPECT_EQ(quick.lost + slow.lost, 0U);
}

TEST(InLockstep, TimeStandsStillWithoutPosesAndAnswersComeAllTheSame) {
    const TempDir directory;
    const DaemonProcess daemon(directory, in_lockstep());
    ScannerWire wire = ScannerWire::tcp(daemon.port());
    EXPECT_EQ(wire.ask("BM"), "00");
    EXPECT_EQ(wire.ask("MD0540054001000"), "00");
    EXPECT_FALSE(wire.next_message(200ms));
    // The room has a second thing that can move, so only scans before the latest stamp are
    // complete.
    for (const char* pose : {"100", "100.06", "100.07"})
        daemon.say(std::string("{\"t\":") + pose + ",\"xyz\":[0,0,0]}\n");
    EXPECT_TRUE(wire.next_message());
    EXPECT_TRUE(wire.next_message());
    EXPECT_FALSE(wire.next_message(200ms));
    EXPECT_EQ(wire.ask("QT"), "00");
    daemon.say("{\"xyz\":[0,0,0]}\n");
    EXPECT_EQ(wire.ask("VV"), "00");
    EXPECT_EQ(daemon.get("/status").at("poses").at("last_refusal"),
              "t is missing: time is that of the poses");
    daemon.say("{\"t\":1e6,\"xyz\":[0,0,0]}\n");
    EXPECT_TRUE(eventually([&] {
        return daemon.get("/status").at("poses").at("last_refusal") ==
               "t: leaps from 100.070 s to 1000000.000 s; a second of stamps that follow it makes "
               "it the time";
    }));
}

TEST(InLockstep, WithoutASourceOfPosesTheLogSaysThatTimeStandsStill) {
    const auto log_of = [](const std::vector<std::string>& words) {
        const TempDir directory;
        DaemonProcess daemon(directory, words);
        daemon.signal(SIGTERM);
        EXPECT_EQ(daemon.wait(), 0);
        return daemon.standard_error();
    };
    const std::string still = "time stands still until poses come";
    std::vector<std::string> words = in_lockstep();
    EXPECT_EQ(log_of(words).find(still), std::string::npos) << "standard input is a source";
    std::erase(words, "--poses");
    std::erase(words, "-");
    const std::string log = log_of(words);
    for (const std::string& part : {still, std::string("--poses SOURCE"), std::string("scipctl")})
        EXPECT_NE(log.find(part), std::string::npos) << log;
}

/// Both times belong to the same sweep, which takes 25 ms.
void expect_within_a_turn(const nlohmann::json& time_s, double of_s) {
    EXPECT_GE(time_s.get<double>(), of_s - 0.025);
    EXPECT_LE(time_s.get<double>(), of_s + 0.025);
}

TEST(InLockstep, AllTimesAreStampsOfThePoses) {
    const TempDir directory;
    const DaemonProcess daemon(directory, in_lockstep());
    WebSocketClient stream(daemon.control(), "/stream");
    // From this question on it keeps scans.
    EXPECT_EQ(control_request(daemon.control(), "GET", "/sensors/robot/scanner/truth").status, 404);
    // A turn of a UST-10LX that begins at the first stamp is complete 25 ms later.
    for (const char* stamp : {"1000.00", "1000.06", "1000.07"})
        daemon.say(std::string("{\"t\":") + stamp + ",\"xyz\":[0,0,0]}\n");
    const auto scan = nlohmann::json::parse(stream.receive());
    expect_within_a_turn(scan.at("time_s"), 1000.0);
    const std::string number = scan.at("scan").dump();
    const auto truth = daemon.get("/sensors/robot/scanner/truth?scan=" + number);
    EXPECT_EQ(truth.at("time_s"), scan.at("time_s"));
    for (const auto& pose : truth.at("poses"))
        expect_within_a_turn(pose.at("time_s"), truth.at("time_s"));
    EXPECT_TRUE(eventually([&] { return daemon.get("/status").at("time_s") == 1000.06; }));
    EXPECT_EQ(daemon.get("/robots/robot/pose").at("t"), 1000.06);

    // A pose that is set at a stamp holds from that stamp on, not from its arrival.
    const auto put = [&](const char* path, const char* body) {
        return control_request(daemon.control(), "PUT", path, body).status;
    };
    EXPECT_EQ(put("/robots/robot/pose", R"({"t":1000.08,"xyz":[1,0,0]})"), 204);
    EXPECT_EQ(put("/robots/robot/pose", R"({"t":1000.08,"xyz":[1,0,0]})"), 409);
    EXPECT_EQ(put("/scene/models/box/pose", R"({"t":1000.08,"xyz":[-2,-2,0]})"), 204);
    EXPECT_EQ(daemon.get("/robots/robot/pose").at("xyz").at(0), 0.0);
    for (const char* stamp : {"1000.09", "1000.10"})
        daemon.say(std::string("{\"t\":") + stamp + ",\"xyz\":[1,0,0]}\n");
    EXPECT_TRUE(eventually([&] { return daemon.get("/status").at("time_s") == 1000.09; }));
    const auto robot = daemon.get("/robots/robot/pose");
    EXPECT_EQ(robot.at("t"), 1000.09);
    EXPECT_EQ(robot.at("xyz").at(0), 1.0);
    const auto model = daemon.get("/scene/models/box/pose");
    EXPECT_EQ(model.at("t"), 1000.09);
    EXPECT_EQ(model.at("xyz").at(0), -2.0);
}

}  // namespace
}  // namespace scipd::tests
