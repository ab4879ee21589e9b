// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// SIGHUP makes a running scipd read its configuration again.
#include <chrono>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include "tests/end_to_end/in_square_room.h"
#include "tests/support/control_request.h"

namespace scipd::tests {
namespace {

using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

/// Lets a process open only this many more descriptors, until it is lifted.
class DescriptorLimit {
  public:
    /// Connections that are about to end count too.
    DescriptorLimit(pid_t process, std::size_t more) : process_(process) {
        const fs::directory_iterator open("/proc/" + std::to_string(process) + "/fd");
        const auto count = static_cast<rlim_t>(std::distance(begin(open), end(open)));
        ::prlimit(process_, RLIMIT_NOFILE, nullptr, &before_);
        const rlimit few{count - 3 + more, before_.rlim_max};
        ::prlimit(process_, RLIMIT_NOFILE, &few, nullptr);
    }
    ~DescriptorLimit() { lift(); }
    DescriptorLimit(const DescriptorLimit&) = delete;
    DescriptorLimit& operator=(const DescriptorLimit&) = delete;

    void lift() const { ::prlimit(process_, RLIMIT_NOFILE, &before_, nullptr); }

  private:
    pid_t process_;
    rlimit before_{};
};

class Reload : public testing::Test {
  protected:
    Reload() : daemon_(directory_, {"--config", write(front + rear)}) {
        EXPECT_NE(daemon_.ready_line(), "") << daemon_.standard_error();
    }

    /// Writes to the same file each time.
    std::string write(const std::string& sensors,
                      const fs::path& world = scene("square_room.sdf")) {
        return directory_.write("rig.yaml", "scene: " + world.string() +
                                                "\nrobots:\n  rescue:\n    sensors:\n" + sensors);
    }

    void reload_and_wait_for(const std::string& word) {
        daemon_.signal(SIGHUP);
        ASSERT_TRUE(eventually([&] {
            return daemon_.standard_error().find(word) != std::string::npos;
        })) << daemon_.standard_error();
    }

    static void expect_no_gap(ScannerWire& wire, std::uint32_t& stamp_ms, int scans = 20) {
        for (int i = 0; i < scans; ++i) {
            const std::uint32_t next_ms = wire.next_scan().stamp_ms;
            ASSERT_EQ(turns_between(stamp_ms, next_ms), 1);
            stamp_ms = next_ms;
        }
    }

    static inline const std::string front =
        "      front: {model: UST-10LX, mount: {xyz: [0, 0, 0.3]}, accuracy: ideal, "
        "tcp: \"127.0.0.1:0\"}\n";
    static inline const std::string rear =
        "      rear: {model: UTM-30LX, mount: {xyz: [0, 0, 0.3]}, accuracy: ideal, "
        "tcp: \"127.0.0.1:0\", pty: auto}\n";
    static inline const std::string top =
        "      top: {model: URG-04LX, mount: {xyz: [0, 0, 0.3]}, accuracy: ideal, pty: auto}\n";

    static inline const std::string elsewhere_ = "control: elsewhere.sock\n";
    static inline const std::string stays_ =
        "control, http with its token, clock and fleet stay as they are";

    TempDir directory_;
    DaemonProcess daemon_;
};

TEST_F(Reload, OfAFaultyFileChangesNothing) {
    ScannerWire wire = ScannerWire::tcp(daemon_.port());
    EXPECT_EQ(wire.ask(stream_of_one_beam), "00");
    std::uint32_t stamp_ms = wire.next_scan().stamp_ms;

    const std::string file = write(front + "      rear: {model: UST-99LX, pty: auto}\n");
    reload_and_wait_for("nothing was changed");
    EXPECT_THAT(daemon_.standard_error(), HasSubstr(file + ":6: robots.rescue.sensors.rear.model"));
    expect_no_gap(wire, stamp_ms);
    EXPECT_EQ(ScannerWire::tty(daemon_.tty(1)).ask("VV"), "00");
}

// Opening a FIFO blocks until somebody writes to it.
TEST_F(Reload, OfAFifoChangesNothing) {
    const fs::path file = write(front + rear);
    fs::remove(file);
    ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
    daemon_.signal(SIGHUP);
    EXPECT_TRUE(eventually(
        [&] { return daemon_.standard_error().find("is a FIFO") != std::string::npos; }));
    EXPECT_EQ(daemon_.get("/sensors").size(), 2U);
    daemon_.signal(SIGTERM);
    EXPECT_EQ(daemon_.wait(), 0);
}

TEST_F(Reload, OfAFileWithAPortInUseChangesNothing) {
    ScannerWire wire = ScannerWire::tcp(daemon_.port(0));
    EXPECT_EQ(wire.ask(stream_of_one_beam), "00");
    std::uint32_t stamp_ms = wire.next_scan().stamp_ms;

    const TempDir elsewhere;
    const DaemonProcess other(elsewhere, on_tcp());
    const std::string taken = "127.0.0.1:" + std::to_string(other.port());
    write(top + "      front: {model: UST-10LX, tcp: \"" + taken + "\"}\n" + elsewhere_);
    reload_and_wait_for("nothing was changed");
    const std::string log = daemon_.standard_error();
    EXPECT_THAT(log, HasSubstr("cannot listen on " + taken));
    EXPECT_THAT(log, Not(HasSubstr("rescue/top: backend ")));
    EXPECT_THAT(log, Not(HasSubstr(stays_)));
    expect_no_gap(wire, stamp_ms);
    EXPECT_FALSE(fs::is_symlink(directory_.path() / "scipd" / "rescue-top"));
    EXPECT_EQ(daemon_.get("/sensors").size(), 2U);
}

// Each round allows one descriptor more, so that each of them fails once.
TEST_F(Reload, ThatRunsOutOfDescriptorsChangesNothing) {
    ScannerWire wire = ScannerWire::tcp(daemon_.port(0));
    EXPECT_EQ(wire.ask(stream_of_one_beam), "00");
    std::uint32_t stamp_ms = wire.next_scan().stamp_ms;
    const auto count = [&](const std::string& word) {
        const std::string log = daemon_.standard_error();
        std::size_t times = 0;
        for (auto at = log.find(word); at != log.npos; at = log.find(word, at + 1))
            ++times;
        return times;
    };
    std::string turned = rear;
    turned.replace(turned.find("[0, 0, 0.3]"), 11, "[1, 0, 0.3]");
    write(front + turned + top);

    const std::string running = "is running now";
    const std::string refused = "nothing was changed";
    for (std::size_t more = 0; count(running) == 0; ++more) {
        ASSERT_LT(more, 64U);
        const DescriptorLimit limit(daemon_.pid(), more);
        daemon_.signal(SIGHUP);
        ASSERT_TRUE(eventually([&] { return count(refused) + count(running) > more; }));
        if (count(running) > 0) break;
        limit.lift();
        expect_no_gap(wire, stamp_ms, 4);
        EXPECT_EQ(daemon_.get("/sensors").size(), 2U);
        EXPECT_EQ(ScannerWire::tty(daemon_.tty(1)).ask("VV"), "00");
        EXPECT_FALSE(fs::is_symlink(directory_.path() / "scipd" / "rescue-top"));
    }
    EXPECT_GE(count(refused), 5U);
    expect_no_gap(wire, stamp_ms);
    EXPECT_EQ(daemon_.get("/sensors").size(), 3U);
    EXPECT_EQ(ScannerWire::tty(directory_.path() / "scipd" / "rescue-top").ask("VV"), "00");
    daemon_.signal(SIGTERM);
    EXPECT_EQ(daemon_.wait(), 0);
}

TEST_F(Reload, KeepsWhatDidNotChange) {
    {
        ScannerWire kept = ScannerWire::tcp(daemon_.port(0));
        ScannerWire removed = ScannerWire::tcp(daemon_.port(1));
        EXPECT_EQ(kept.ask(stream_of_one_beam), "00");
        EXPECT_EQ(removed.ask(stream_of_one_beam), "00");
        std::uint32_t stamp_ms = kept.next_scan().stamp_ms;

        write(top + front);
        reload_and_wait_for("is running now; new: rescue/top; gone: rescue/rear");
        expect_no_gap(kept, stamp_ms);
        EXPECT_TRUE(removed.ends());
        EXPECT_FALSE(fs::is_symlink(daemon_.tty(1)));

        const auto sensors = daemon_.get("/status").at("sensors");
        ASSERT_EQ(sensors.size(), 2U);
        EXPECT_EQ(sensors[0].at("name"), "rescue/top");
        EXPECT_EQ(sensors[1].at("name"), "rescue/front");
        EXPECT_EQ(sensors[1].at("tcp"), "127.0.0.1:" + std::to_string(daemon_.port(0)));
        ScannerWire added = ScannerWire::tty(sensors[0].at("pty").get<std::string>());
        EXPECT_EQ(added.ask("VV"), "00");
        EXPECT_EQ(kept.ask("QT"), "00");
    }
    // Backends are measured while no client is connected.
    EXPECT_TRUE(eventually([&] {
        return daemon_.standard_error().find("rescue/top: backend ") != std::string::npos;
    }));
}

TEST_F(Reload, SaysEachTimeWhatWaitsForTheNextStart) {
    const auto times_said = [&] {
        const std::string log = daemon_.standard_error();
        int times = 0;
        for (auto at = log.find(stays_); at != log.npos; at = log.find(stays_, at + 1))
            ++times;
        return times;
    };
    for (const int times : {1, 2}) {
        write(front + elsewhere_);
        daemon_.signal(SIGHUP);
        EXPECT_TRUE(eventually([&] { return times_said() == times; })) << times;
    }
    // This configuration asks for nothing that must wait for the next start.
    write(top);
    daemon_.signal(SIGHUP);
    EXPECT_TRUE(eventually([&] { return daemon_.get("/sensors")[0].at("model") == "URG-04LX"; }));
    EXPECT_EQ(times_said(), 2);
}

TEST_F(Reload, AskedForOverAndOverCostsNoScan) {
    ScannerWire wire = ScannerWire::tcp(daemon_.port());
    EXPECT_EQ(wire.ask(stream_of_one_beam), "00");
    std::uint32_t stamp_ms = wire.next_scan().stamp_ms;
    // Loading the world 100 times would take seconds.
    for (int i = 0; i < 100; ++i) {
        daemon_.signal(SIGHUP);
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    for (int i = 0; i < 3; ++i)
        expect_no_gap(wire, stamp_ms);
    EXPECT_EQ(wire.ask("QT"), "00");
}

TEST_F(Reload, CutsOffTheClientOfAChangedScannerOnly) {
    ScannerWire kept = ScannerWire::tcp(daemon_.port(0));
    ScannerWire cut = ScannerWire::tcp(daemon_.port(1));
    ScannerWire tty = ScannerWire::tty(daemon_.tty(1));
    EXPECT_EQ(kept.ask(stream_of_one_beam), "00");
    EXPECT_EQ(cut.ask(stream_of_one_beam), "00");
    EXPECT_EQ(tty.ask("VV"), "00");
    std::uint32_t stamp_ms = kept.next_scan().stamp_ms;

    std::string turned = rear;
    turned.replace(turned.find("[0, 0, 0.3]"), 11, "[1, 0, 0.3]");
    write(front + turned);
    reload_and_wait_for("is running now");
    expect_no_gap(kept, stamp_ms);
    EXPECT_TRUE(cut.ends());

    // The changed scanner now has the same port and tty. It is 1 m nearer to the front wall.
    ScannerWire again = ScannerWire::tcp(daemon_.port(1));
    EXPECT_EQ(again.ask(stream_of_one_beam), "00");
    EXPECT_EQ(again.next_scan().distances_mm.front(), 2000U);
    EXPECT_TRUE(tty.ends());
    EXPECT_EQ(ScannerWire::tty(daemon_.tty(1)).ask("VV"), "00");
}

// A client that closes a tty which has hung up has been logged before.
TEST_F(Reload, LogsOnceThatTheClientOfATtyHasGone) {
    ScannerWire tty = ScannerWire::tty(daemon_.tty(1));
    EXPECT_EQ(tty.ask("BM"), "00");
    std::string other = rear;
    other.replace(other.find("UTM-30LX"), 8, "UST-20LX");
    write(front + other);
    reload_and_wait_for("is running now");
    EXPECT_TRUE(tty.ends());
    tty.close();
    {
        ScannerWire again = ScannerWire::tty(daemon_.tty(1));
        EXPECT_EQ(again.ask("VV"), "00");
    }
    ASSERT_TRUE(eventually([&] { return daemon_.get("/sensors")[1].at("clients") == 0; }));
    daemon_.signal(SIGTERM);
    EXPECT_EQ(daemon_.wait(), 0);
    const std::string log = daemon_.standard_error();
    const auto changed = log.find("client disconnected (the scanner was changed");
    const auto closed = log.find("client disconnected (closed the tty)");
    ASSERT_NE(changed, log.npos) << log;
    ASSERT_NE(closed, log.npos) << log;
    EXPECT_LT(changed, closed) << log;
    EXPECT_EQ(log.find("client disconnected", closed + 1), log.npos) << log;
    EXPECT_EQ(log.find("client disconnected"), changed) << log;
}

TEST_F(Reload, TellsThatAScannerReadsAsTheFileSaysAgain) {
    ASSERT_EQ(control_request(daemon_.control(), "PATCH", "/sensors/rescue/front",
                              R"({"accuracy":"sensor","noise":4})")
                  .status,
              200);
    reload_and_wait_for("is running now; changed: rescue/front");
    EXPECT_EQ(daemon_.get("/sensors/rescue/front").at("errors").at("noise"), 1);
}

TEST_F(Reload, ShowsAnotherWorldToThoseWhoStay) {
    ScannerWire wire = ScannerWire::tcp(daemon_.port());
    EXPECT_EQ(wire.ask(stream_of_one_beam), "00");
    auto scan = wire.next_scan();
    EXPECT_EQ(scan.distances_mm.front(), 3000U);

    const auto other = directory_.write("wall.sdf", R"(<sdf version="1.9"><world name="wall">
        <model name="wall"><static>true</static><link name="link"><visual name="wall">
        <pose>4.5 0 0.5 0 0 0</pose><geometry><box><size>1 2 2</size></box></geometry>
        </visual></link></model></world></sdf>)");
    write(front + rear, other);
    reload_and_wait_for("is running now");
    // Scans that were sent before the change come first.
    for (int i = 0; i < 2000 && scan.distances_mm.front() == 3000; ++i)
        scan = wire.next_scan();
    EXPECT_EQ(scan.distances_mm.front(), 4000U);
}

}  // namespace
}  // namespace scipd::tests
