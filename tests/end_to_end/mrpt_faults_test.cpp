// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a driver that others wrote, MRPT's CHokuyoURG, does with each scenario of scenes/faults/.
// The first comment of each file says the same.
#include "tests/end_to_end/mrpt_faults.h"

#include <chrono>
#include <thread>

#include <nlohmann/json.hpp>

#include "tests/support/scanner_wire.h"

namespace scipd::tests {
namespace {

using namespace std::chrono_literals;

TEST_F(MrptFaultsTest, ConnectsAnewWhenTheCableIsInAgain) {
    start();
    const auto driver = connect(Link::tcp);
    run("cable_pulled.yaml");
    const Seen seen = watch_until_over(*driver);
    EXPECT_TRUE(seen.silent);
    EXPECT_GT(seen.failures, 0);
    expect_scans(*driver);
}

TEST_F(MrptFaultsTest, OpensTheTtyAnewWhenTheCableIsInAgain) {
    start();
    const auto driver = connect(Link::tty);
    run("cable_pulled.yaml");
    const Seen seen = watch_until_over(*driver);
    EXPECT_TRUE(seen.silent);
    EXPECT_GT(seen.failures, 0);
    expect_scans(*driver);
}

TEST_F(MrptFaultsTest, TakesScansWithWrongSums) {
    start();
    run("errors_at_power_on.yaml");
    MrptDriver driver(*daemon_, Link::tcp, 0, true);
    const Seen seen = watch_until_over(driver);
    EXPECT_GT(seen.scans, 20);
    EXPECT_LT(seen.failures, seen.scans / 2);
    expect_scans(driver);
}

TEST_F(MrptFaultsTest, LooksAtNoSumOfTheVersion) {
    start();
    run("wrong_version_sum.yaml");
    (void)connect(Link::tcp);
    const auto log = daemon_->get("/sensors/robot/scanner/faults/log");
    EXPECT_EQ(log["entries"].back()["request"], "VV") << log;
}

// Whether it finds its way back depends on when it connects anew.
TEST_F(MrptFaultsTest, DoesNotStartWhereTheScannerBootsWhileItIsProbed) {
    start();
    run("reboot_while_probed.yaml");
    MrptDriver driver(*daemon_, Link::tcp);
    expect_no_scan(driver, 1s);
    std::this_thread::sleep_for(3s);
    (void)connect(Link::tty);
}

TEST_F(MrptFaultsTest, LeavesAnAbnormalScannerToSomebodyElse) {
    // It boots at once.
    start({"--tcp", "127.0.0.1:0", "--pty", "auto", "--timing", "ideal"});
    const auto driver = connect(Link::tcp);
    run("abnormal_until_reboot.yaml");
    const Seen seen = watch(*driver, [](const Seen& now) { return now.silent; });
    EXPECT_GE(seen.failures, 1);
    expect_no_scan(*driver, 2s);
    EXPECT_FALSE(over());
    ScannerWire tty = ScannerWire::tty(daemon_->tty());
    EXPECT_EQ(tty.ask("MD0000108010001"), "0L");
    EXPECT_EQ(tty.ask("RB"), "01");
    EXPECT_EQ(tty.ask("RB"), "00");
    expect_scans(*driver);
    EXPECT_TRUE(over());
}

TEST_F(MrptFaultsTest, WaitsForEverWhenSomebodyElsesQuestionEndsItsStream) {
    start();
    const auto driver = connect(Link::tcp);
    run("status_query.yaml");
    // It never asks itself.
    (void)watch(*driver, [](const Seen& seen) { return seen.scans >= 40; });
    EXPECT_EQ(ScannerWire::tty(daemon_->tty()).ask("II"), "00");
    (void)watch(*driver, [](const Seen& seen) { return seen.silent; });
    std::this_thread::sleep_for(1s);
    expect_no_scan(*driver, 2s);
    (void)connect(Link::tty);
}

TEST_F(MrptFaultsTest, TellsWrongTimesWhileTheClockIsWrong) {
    start();
    const auto driver = connect(Link::tcp);
    // It begins to use the stamps of the scanner with the tenth scan.
    (void)watch(*driver, [](const Seen& seen) { return seen.scans >= 20; });
    run("clock_troubles.yaml");
    // Its last step waits for a TM1, which MRPT never sends.
    const auto step_before_last_ended = [this](const Seen&) {
        return daemon_->get("/scenario")["steps"][2]["state"] == "ended";
    };
    const Seen seen = watch(*driver, step_before_last_ended);
    EXPECT_GT(seen.off_time, 40);
    EXPECT_EQ(seen.failures, 0);
    const Seen after = watch(*driver, [](const Seen& now) { return now.scans >= 20; });
    EXPECT_EQ(after.off_time, 0);
}

TEST_F(MrptFaultsTest, PutsPiecesTogether) {
    start();
    const auto driver = connect(Link::tcp);
    run("joined_and_split.yaml");
    const Seen seen = watch_until_over(*driver);
    EXPECT_EQ(seen.failures, 0);
    EXPECT_GT(seen.scans, 100);
    expect_scans(*driver);
}

// As above.
TEST_F(MrptFaultsTest, DoesNotStartWhereIntensityMakesTheScannerBoot) {
    start();
    run("crash_on_intensity.yaml");
    MrptDriver driver(*daemon_, Link::tcp, 0, true);
    expect_no_scan(driver, 1s);
    std::this_thread::sleep_for(3s);
    (void)connect(Link::tty);
}

}  // namespace
}  // namespace scipd::tests
