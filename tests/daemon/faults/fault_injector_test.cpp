// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Faults of a device whose turns the test tells, late as a slow machine does.
#include "daemon/faults/fault_injector.h"

#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "daemon/clock/stepped_clock.h"
#include "daemon/device/device.h"
#include "daemon/faults/read_fault.h"
#include "tests/daemon/wall_world.h"

namespace scipd::daemon {
namespace {

class LateTurnsTest : public testing::Test {
  protected:
    void SetUp() override {
        client_->receive("MD0540054000000\n");
        (void)messages();
    }

    /// Its messages that were not asked for yet.
    std::size_t messages() {
        std::size_t count = 0;
        while (const auto action = client_->session().next_action())
            count += static_cast<std::size_t>(std::holds_alternative<protocol::Send>(*action));
        return count;
    }

    void tell_turns(int turns) {
        for (int turn = 0; turn < turns; ++turn) {
            device_.turn_complete(revolution_++);
            (void)messages();
        }
    }

    SteppedClock clock_;
    World world_ = wall_world();
    Device device_{"robot", ideal_sensor(), 1, world_, clock_};
    FaultInjector injector_{device_, {}, {}, clock_};
    std::unique_ptr<Endpoint::Client> client_ = device_.connect([] {}, protocol::LinkKind::network);
    std::int64_t revolution_ = device_.next_revolution();
};

TEST_F(LateTurnsTest, AFaultForOneScanChangesTheNextOneAlone) {
    tell_turns(3);
    clock_.advance_to(device_.leaves(revolution_ + 3));
    injector_.start(parse_fault(R"({"kind":"sums","for":{"scans":1}})").value(), 1);
    tell_turns(4);
    ASSERT_EQ(injector_.list().size(), 1U);
    EXPECT_EQ(injector_.list().front().state, "ended");
    EXPECT_EQ(injector_.list().front().hits, 1U);
}

TEST_F(LateTurnsTest, ARecordTellsWhichFaultsChangedItsReadings) {
    const auto next = [&] {
        clock_.advance_to(device_.leaves(revolution_));
        tell_turns(1);
        return device_.log().latest()->faults;
    };
    EXPECT_TRUE(next().empty());
    const auto dirt = parse_fault(R"({"kind":"dirty","steps":[500,502]})");
    const auto id = injector_.start(dirt.value(), 1);
    injector_.start(parse_fault(R"({"kind":"freeze"})").value(), 1);
    injector_.start(parse_fault(R"({"kind":"sums"})").value(), 1);
    const auto faults = next();
    ASSERT_EQ(faults.size(), 2U);
    EXPECT_EQ(faults[0].kind, "freeze");
    EXPECT_TRUE(faults[0].steps.empty());
    EXPECT_EQ(faults[1].kind, "dirty");
    EXPECT_EQ(faults[1].what, "the window is dirty");
    EXPECT_EQ(faults[1].steps, (std::vector{500, 501, 502}));
    injector_.stop(id);
    EXPECT_EQ(next().size(), 1U);
}

}  // namespace
}  // namespace scipd::daemon
