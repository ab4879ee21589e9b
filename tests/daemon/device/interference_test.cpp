// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Two scanners that look at each other, and whose mirrors drift apart.
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "daemon/clock/stepped_clock.h"
#include "daemon/device/device.h"
#include "tests/daemon/wall_world.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;

constexpr double apart_m = 3.0;

SensorConfig facing(const std::string& name, const sim::Pose& mount,
                    std::optional<double> ppm = std::nullopt) {
    SensorConfig config = ideal_sensor();
    config.name = name;
    config.robot_from_sensor = mount;
    config.interference = true;
    config.clock.ppm = ppm;
    return config;
}

/// One at the origin that looks along x, and one that looks back at it.
class Interference : public testing::Test {
  protected:
    void make(const sim::Scene& scene, double turned_rad = std::numbers::pi) {
        make(scene, facing("here", {}, 0.0),
             facing("there", sim::pose_from_rpy({apart_m, 0, 0}, {0, 0, turned_rad}), 1000.0));
    }
    void make(const sim::Scene& scene, const SensorConfig& here, const SensorConfig& there) {
        const auto shared = std::make_shared<const sim::Scene>(scene);
        world_.replace_scene(shared, one_backend(shared, {"robot/here", "robot/there"}));
        world_.set_robots({{"robot", {}}});
        here_.emplace("robot", here, 1, world_, clock_);
        there_.emplace("robot", there, 1, world_, clock_);
    }
    void switch_on(Device& device) {
        clients_.push_back(device.connect([] {}, protocol::LinkKind::network));
        clients_.back()->receive("BM\n");
        clock_.advance_to(clock_.now() + 1ms);
        clients_.back()->wake();
        ASSERT_TRUE(device.state().laser_on());
    }
    /// In how many of so many scans of the first one a beam is disturbed; `beams` gathers which.
    int disturbed(int scans) {
        int count = 0;
        here_->watch([&](const ScanRecord& record) {
            if (!record.cast->dazzled.empty()) ++count;
            beams_.insert(record.cast->dazzled.begin(), record.cast->dazzled.end());
            for (const std::uint32_t beam : record.cast->dazzled)
                EXPECT_EQ(record.sent.distance[beam], 65533U);
        });
        std::int64_t revolution = here_->next_revolution();
        for (int i = 0; i < scans; ++i, ++revolution) {
            clock_.advance_to(here_->leaves(revolution));
            here_->turn_complete(revolution);
        }
        return count;
    }

    SteppedClock clock_;
    World world_;
    std::optional<Device> here_;
    std::optional<Device> there_;
    std::vector<std::unique_ptr<Endpoint::Client>> clients_;
    std::set<std::uint32_t> beams_;
};

// A clock that runs 1000 ppm too fast turns its mirror once more than the other in 1000 turns. In
// that time each phase comes once. Both windows and both beams are open for an arc of twice their
// half widths, and the two overlap for the sum of both arcs.
TEST_F(Interference, ComesOnceWhileTheMirrorsDriftThroughATurn) {
    make(sim::Scene{});
    switch_on(*there_);
    const double arc_rad = 2.0 * (0.0066 + std::atan2(window_radius_m, apart_m));
    const double expected = 2.0 * arc_rad / (2.0 * std::numbers::pi) * 1000.0;
    EXPECT_NEAR(disturbed(1000), expected, 2.0);
    ASSERT_FALSE(beams_.empty());
    // Straight ahead is step 540; a step is a quarter of a degree.
    const double most_steps = 0.5 * arc_rad * 1440 / (2.0 * std::numbers::pi) + 1.0;
    EXPECT_GE(double(*beams_.begin()), 540 - most_steps);
    EXPECT_LE(double(*beams_.rbegin()), 540 + most_steps);
    clients_.clear();
}

struct Runs {
    int runs = 0;       ///< of disturbed scans
    int disturbed = 0;  ///< scans
};

class TwoOfAKind : public Interference, public testing::WithParamInterface<const char*> {
  protected:
    /// Who looks at every fourth scan misses no run: the shortest has a dozen scans.
    Runs look_for(sim::Time time) {
        constexpr int every = 4;
        Runs seen;
        bool before = false;
        const sim::Time end = clock_.now() + time;
        for (std::int64_t revolution = here_->next_revolution(); here_->leaves(revolution) < end;
             revolution += every) {
            clock_.advance_to(here_->leaves(revolution));
            const bool now = disturbed_in(revolution);
            seen.disturbed += now ? every : 0;
            seen.runs += now && !before ? 1 : 0;
            before = now;
        }
        return seen;
    }

  private:
    bool disturbed_in(std::int64_t revolution) {
        bool disturbed = false;
        here_->watch([&](const ScanRecord& record) { disturbed = !record.cast->dazzled.empty(); });
        here_->turn_complete(revolution);
        here_->watch(nullptr);
        return disturbed;
    }
};

// Nobody says how they differ: their serial numbers do.
TEST_P(TwoOfAKind, DisturbEachOtherForAWhileNowAndThen) {
    SensorConfig here = facing("here", {});
    SensorConfig there =
        facing("there", sim::pose_from_rpy({apart_m, 0, 0}, {0, 0, std::numbers::pi}));
    here.timing = there.timing = std::string(GetParam()) == "real" ? Timing::real : Timing::ideal;
    make(sim::Scene{}, here, there);
    switch_on(*there_);
    const auto ten_minutes = 10min;
    const Runs seen = look_for(ten_minutes);
    clients_.clear();

    // How often the one mirror overtakes the other.
    const Unit mine(here, here_->chance(sim::Purpose::unit));
    const Unit other(there, there_->chance(sim::Purpose::unit));
    const double apart_ppm =
        std::abs((mine.clock_ppm - mine.turn_ppm) - (other.clock_ppm - other.turn_ppm));
    const double turns = std::chrono::duration<double>(ten_minutes) /
                         std::chrono::duration<double>(here_->profile().scan_period);
    EXPECT_GE(apart_ppm, 50.0);  // or nothing is to be seen in so short a time
    EXPECT_NEAR(seen.runs, turns * apart_ppm * 1e-6, 1.0);
    EXPECT_GE(seen.runs, 1);
    EXPECT_GE(seen.disturbed, 12 * seen.runs);
    EXPECT_LE(seen.disturbed, 0.05 * turns);
}

INSTANTIATE_TEST_SUITE_P(Timing, TwoOfAKind, testing::Values("real", "ideal"),
                         [](const auto& timing) { return std::string(timing.param); });

TEST_F(Interference, NeedsALaserThatIsOn) {
    make(sim::Scene{});
    EXPECT_EQ(disturbed(1000), 0);
}

// A UST measures 270 degrees, and its laser is off in the rest.
TEST_F(Interference, DoesNotComeFromBehindAScanner) {
    make(sim::Scene{}, 0.0);
    switch_on(*there_);
    EXPECT_EQ(disturbed(1000), 0);
    clients_.clear();
}

TEST_F(Interference, IsHiddenByAWall) {
    make(*sim::SceneBuilder()
              .add(sim::Box{{0.1, 1.0, 1.0}}, sim::pose_from_rpy({1.5, 0, 0}, {0, 0, 0}))
              .build());
    switch_on(*there_);
    EXPECT_EQ(disturbed(1000), 0);
    clients_.clear();
}

}  // namespace
}  // namespace scipd::daemon
