// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What scipbench capacity stands on: its search, its looks at processes, its bare timer, and what
// it makes of figures.
#include <algorithm>
#include <chrono>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include "tests/support/temp_dir.h"
#include "tools/child_program.h"
#include "tools/scipbench/bare_timer.h"
#include "tools/scipbench/capacity.h"
#include "tools/scipbench/capacity_report.h"
#include "tools/scipbench/processor_use.h"

namespace scipd::tools {
namespace {

using namespace std::chrono_literals;
using tests::TempDir;

/// A machine that holds so many.
struct Machine {
    int holds;
    std::vector<int> asked = {};

    Capacity search(int first, int limit) {
        return find_capacity(first, limit, [this](int number) {
            asked.push_back(number);
            return number <= holds;
        });
    }
};

TEST(Capacity, FindsTheNumberToATwentieth) {
    for (const int holds : {1, 2, 15, 16, 17, 100, 999, 1023, 5000}) {
        Machine machine{holds};
        const Capacity found = machine.search(16, 10'000);
        EXPECT_LE(found.held, holds);
        ASSERT_TRUE(found.too_many) << holds;
        EXPECT_GT(*found.too_many, holds);
        EXPECT_LE(*found.too_many - found.held, std::max(1, found.held / 20)) << holds;
        EXPECT_LE(machine.asked.size(), 16U) << holds;
    }
}

TEST(Capacity, EndsAtTheLimit) {
    Machine machine{1000};
    const Capacity found = machine.search(16, 100);
    EXPECT_EQ(found.held, 100);
    EXPECT_FALSE(found.too_many);
    EXPECT_EQ(machine.asked, (std::vector{16, 32, 64, 100}));
    EXPECT_EQ(machine.search(16, 3).held, 3);
}

TEST(Capacity, SaysWhereNotEvenOneHolds) {
    Machine machine{0};
    const Capacity found = machine.search(16, 100);
    EXPECT_EQ(found.held, 0);
    EXPECT_EQ(found.too_many, 1);
}

double processor_seconds() {
    rusage use{};
    ::getrusage(RUSAGE_SELF, &use);
    const auto seconds = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    return seconds(use.ru_utime) + seconds(use.ru_stime);
}

TEST(ProcessorUse, AgreesWithWhatTheProcessIsTold) {
    const double told_s = processor_seconds();
    const auto before = processor_use_of(::getpid());
    while (processor_seconds() < told_s + 0.3) {
    }
    const auto after = processor_use_of(::getpid());
    ASSERT_TRUE(before && after);
    const ProcessorUse use = use_between(*before, *after, 1.0);
    const double tick_s = 0.02;
    EXPECT_NEAR(use.user_s + use.kernel_s, 0.3, 3 * tick_s);
    EXPECT_NEAR(busiest_of(use).ran_s, 0.3, 3 * tick_s);
    EXPECT_NEAR(use_between(*before, *after, 2.0).user_s, use.user_s / 2.0, 1e-9);
}

TEST(ProcessorUse, KnowsNoProcessThatIsGone) {
    const TempDir directory;
    ChildProgram child({"/bin/true"}, directory.path(), "true");
    const pid_t pid = child.pid();
    while (!child.exit_code())
        std::this_thread::sleep_for(1ms);
    EXPECT_FALSE(processor_use_of(pid));
    EXPECT_DOUBLE_EQ(busiest_of({}).ran_s, 0.0);
}

int outcome_of(ChildProgram& child) {
    while (!child.exit_code())
        std::this_thread::sleep_for(1ms);
    return *child.exit_code();
}

TEST(ChildProgram, TellsWhatItSaidAndHowItEnded) {
    const TempDir directory;
    ChildProgram child({"/bin/sh", "-c", "echo out; echo err >&2; exit 3"}, directory.path(), "sh");
    EXPECT_EQ(outcome_of(child), 3);
    EXPECT_EQ(child.output(), "out\n");
    EXPECT_EQ(child.errors(), "err\n");
    ChildProgram none({"/no/such/program"}, directory.path(), "none");
    EXPECT_EQ(outcome_of(none), 127);
}

TEST(ChildProgram, EndsWithItsObject) {
    const TempDir directory;
    pid_t pid = -1;
    {
        const ChildProgram child({"/bin/sleep", "1000"}, directory.path(), "sleep");
        pid = child.pid();
        EXPECT_TRUE(processor_use_of(pid));
    }
    EXPECT_FALSE(processor_use_of(pid));
}

TEST(BareTimer, IsNeverEarlyAndLeavesNothingOut) {
    const auto begin = BareTimer::Clock::now();
    BareTimer timer(5ms);
    std::this_thread::sleep_for(100ms);
    const auto end = BareTimer::Clock::now();
    const std::vector<double> late_ms = timer.late_ms_since(begin);
    // It goes on until it is stopped, and then wakes once more.
    EXPECT_GE(late_ms.size(), 19U);
    EXPECT_LE(late_ms.size(),
              static_cast<std::size_t>((BareTimer::Clock::now() - begin) / 5ms) + 1);
    EXPECT_GE(late_ms.front(), 0.0);
    EXPECT_TRUE(std::is_sorted(late_ms.begin(), late_ms.end()));
    BareTimer other(5ms);
    EXPECT_TRUE(other.late_ms_since(end + 1h).empty());
}

/// A run of ten seconds in which nothing was lost.
CapacityRun sound_run() {
    return {.scanners = 10, .whole = true, .seconds = 10.0, .scans = 4000, .scans_due = 4000.0};
}

TEST(CapacityRun, HoldsIfAllScansCameInTime) {
    EXPECT_TRUE(sound_run().holds());
    // The first turn or two of each scanner have no scan.
    CapacityRun late = sound_run();
    late.scans = 3980;
    EXPECT_TRUE(late.holds());
    late.scans = 3700;
    EXPECT_TRUE(late.falls_behind());
    EXPECT_FALSE(late.holds());
    CapacityRun unread = sound_run();
    unread.whole = false;
    EXPECT_FALSE(unread.holds());
    CapacityRun lost = sound_run();
    lost.lost = 1;
    EXPECT_FALSE(lost.holds());
    CapacityRun failed = sound_run();
    failed.failure = "no scipd";
    EXPECT_FALSE(failed.holds());
}

TEST(CapacityReport, TellsBareCastsAsAShareOfAllCores) {
    // 400 scans a second of 25 ms each are ten cores.
    EXPECT_DOUBLE_EQ(bare_share(sound_run(), {.bare_cast_us = 25'000.0}),
                     10.0 / std::thread::hardware_concurrency());
}

TEST(CapacityReport, NamesWhatLimits) {
    const double all = std::thread::hardware_concurrency();
    CapacityRun run = sound_run();
    run.scipd_use.user_s = 0.8 * all;
    run.reader_use.kernel_s = 0.15 * all;
    EXPECT_TRUE(what_limits(run).starts_with("the cores: ")) << what_limits(run);

    run.scipd_use = {.user_s = 0.5 * all,
                     .threads = {{7, {"scans 0", 0.1}}, {8, {"scans 1", 0.95}}}};
    EXPECT_TRUE(what_limits(run).starts_with("the thread \"scans 1\" of scipd"))
        << what_limits(run);

    run.scipd_use.threads = {{7, {"scans 0", 0.3, 0.7}}};
    EXPECT_TRUE(what_limits(run).starts_with("others on this machine")) << what_limits(run);

    run.scipd_use.threads = {{7, {"scans 0", 0.3, 0.01}}};
    EXPECT_TRUE(what_limits(run).starts_with("no core was full")) << what_limits(run);

    run.failure = "the reader fails: no";
    EXPECT_EQ(what_limits(run), "the reader fails: no");
}

}  // namespace
}  // namespace scipd::tools
