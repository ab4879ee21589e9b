// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The scenario of a configuration, from its file to the scanners that it is for.
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/faults/fault_injector.h"
#include "daemon/faults/fault_kind.h"
#include "daemon/faults/fault_values.h"
#include "daemon/plan/rig_plan.h"
#include "daemon/rig/rig.h"
#include "daemon/rig/simulation.h"
#include "sim/loaders/file/load_error.h"
#include "tests/daemon/device/ideal_camera.h"
#include "tests/daemon/wall_world.h"
#include "tests/support/temp_dir.h"

namespace scipd::daemon {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;

/// So far away that they wait until the test is over.
constexpr const char* front_and_all = R"(steps:
- {sensor: rescue/front, kind: state, state: laser, at: {scan: 900000000}}
- {sensor: "*", kind: reboot, at: {scan: 900000000}, seed: 5}
)";

struct Drawn {
    std::int64_t scan;
    double chance;
};
std::vector<Drawn> drawn;

/// Keeps its chance.
class Draw : public FaultEffect {
  public:
    using Members = NoMembers;
    static constexpr auto& members = no_members;
    static void check(const Members&, const sim::YamlField&, sim::YamlFaults&) {}

    explicit Draw(const Members&) {}

    void begin(FaultScene& scene) override { drawn.push_back({scene.scan(), scene.chance(0)}); }
};

class RigScenarioTest : public testing::Test {
  protected:
    static SensorConfig scanner(const std::string& name) {
        SensorConfig sensor = ideal_sensor();
        sensor.name = name;
        sensor.tcp = Address{"127.0.0.1", 0};
        return sensor;
    }

    Config of(std::vector<SensorConfig> sensors, const std::string& scenario) const {
        Config config;
        config.scene = SCIPD_SCENES "/square_room.sdf";
        config.robots.push_back({.name = "rescue", .sensors = std::move(sensors)});
        if (!scenario.empty()) config.scenario = directory_.write("bad_day.yaml", scenario);
        return config;
    }

    [[nodiscard]] ScenarioStatus status() {
        const auto told = simulation().scenario.status(simulation().scanners());
        return told.value_or(ScenarioStatus{.name = "none", .state = "none", .steps = {}});
    }

    /// "1 rescue/front state 1": step, sensor, kind and id of each fault.
    [[nodiscard]] std::vector<std::string> steps() {
        std::vector<std::string> steps;
        for (const ScenarioStepStatus& step : status().steps)
            steps.push_back(std::to_string(step.step) + " " + step.sensor + " " + step.fault.kind +
                            " " + std::to_string(step.fault.id));
        return steps;
    }

    [[nodiscard]] Simulation& simulation() { return rig_.simulation(); }

    boost::asio::io_context io_;
    tests::TempDir directory_;
    Rig rig_{io_.get_executor(), ClockKind::wall};
};

TEST_F(RigScenarioTest, BeginsWithItsConfiguration) {
    rig_.apply(of({scanner("front"), scanner("rear"), ideal_camera(4, 25.0)}, front_and_all));
    EXPECT_EQ(status().name, (directory_.path() / "bad_day.yaml").string());
    EXPECT_EQ(status().state, "running");
    EXPECT_THAT(steps(), ElementsAre("1 rescue/front state 1", "2 rescue/front reboot 2",
                                     "2 rescue/rear reboot 1"));
    EXPECT_EQ(status().steps[2].fault.state, "waiting");
    EXPECT_EQ(status().steps[2].fault.said,
              R"({"kind":"reboot","at":{"scan":900000000},"seed":5})");
}

TEST_F(RigScenarioTest, GoesOnWhereItIsTheSameAndTakesNewScannersIn) {
    rig_.apply(of({scanner("front")}, front_and_all));
    rig_.apply(of({scanner("front"), scanner("rear")}, std::string("# again\n") + front_and_all));
    EXPECT_THAT(steps(), ElementsAre("1 rescue/front state 1", "2 rescue/front reboot 2",
                                     "2 rescue/rear reboot 1"));
}

TEST_F(RigScenarioTest, IsReplacedByAnotherAndStoppedByNone) {
    rig_.apply(of({scanner("front")}, front_and_all));
    rig_.apply(of({scanner("front")}, std::string("seed: 2\n") + front_and_all));
    EXPECT_THAT(steps(), ElementsAre("1 rescue/front state 3", "2 rescue/front reboot 4"));
    rig_.apply(of({scanner("front")}, {}));
    EXPECT_THAT(steps(), IsEmpty());
    EXPECT_EQ(status().state, "ended");
    // A scanner that comes later has none either.
    rig_.apply(of({scanner("front"), scanner("rear")}, {}));
    EXPECT_THAT(steps(), IsEmpty());
}

TEST_F(RigScenarioTest, LeavesFaultsAloneThatWereAskedForSingly) {
    rig_.apply(of({scanner("front")}, front_and_all));
    FaultInjector& injector = *simulation().scanners().at(0).injector;
    const auto single = parse_fault(R"({"kind":"reboot","at":{"scan":900000000}})");
    ASSERT_TRUE(single);
    const std::uint64_t id = injector.start(*single, 1);
    EXPECT_EQ(steps().size(), 2U);
    simulation().scenario.stop(simulation().scanners());
    EXPECT_EQ(status().state, "ended");
    ASSERT_EQ(injector.list().size(), 1U);
    EXPECT_EQ(injector.list()[0].id, id);
}

TEST_F(RigScenarioTest, HasTheSameChanceWhateverWasRunBefore) {
    rig_.apply(of({scanner("front"), scanner("rear")}, {}));
    const auto targets = simulation().scanners();
    const auto single = parse_fault(R"({"kind":"reboot"})");
    ASSERT_TRUE(single);
    static constexpr FaultKind draw = kind_of<Draw>("draw", "scans", "Draws a number.", true);
    const Scenario scenario =
        parse_scenario(R"(steps: [{sensor: "*", kind: draw}])", "draw.yaml", {}, {&draw});
    // The next scan may begin in between.
    do {
        drawn.clear();
        simulation().scenario.run(scenario, targets);
        (void)targets.at(0).injector->start(*single, 1);
        simulation().scenario.run(scenario, targets);
        ASSERT_EQ(drawn.size(), 4U);
    } while (drawn[0].scan != drawn[2].scan || drawn[0].scan != drawn[1].scan);
    EXPECT_EQ(drawn[0].chance, drawn[2].chance);
    EXPECT_EQ(drawn[1].chance, drawn[3].chance);
    EXPECT_NE(drawn[0].chance, drawn[1].chance)
        << "what is one step for two scanners hits both alike";
}

TEST_F(RigScenarioTest, ThatWasRunByHandStaysWhereTheConfigurationHasNoOther) {
    const Config config = of({scanner("front")}, front_and_all);
    rig_.apply(config);
    const Scenario by_hand = parse_scenario(
        R"(steps: [{sensor: "*", kind: reboot, at: {scan: 900000000}}])", "by_hand", {});
    simulation().scenario.run(by_hand, simulation().scanners());
    EXPECT_THAT(steps(), ElementsAre("1 rescue/front reboot 3"));
    rig_.apply(config);
    EXPECT_EQ(status().name, "by_hand");
    EXPECT_THAT(steps(), ElementsAre("1 rescue/front reboot 3"));
}

TEST_F(RigScenarioTest, ChangesNothingWhereItIsWrong) {
    rig_.apply(of({scanner("front")}, front_and_all));
    Config wrong = of({scanner("front"), ideal_camera(4, 25.0)}, "seed: x\nsteps: []\n");
    wrong.places["scenario"] = "rig.yaml:3: scenario: ";
    const std::string place =
        "rig.yaml:3: scenario: " + (directory_.path() / "bad_day.yaml").string();
    try {
        rig_.apply(wrong);
        FAIL();
    } catch (const sim::LoadError& error) {
        EXPECT_THAT(error.faults(),
                    ElementsAre(place + ":1: seed: must be a whole number from 0 to "
                                        "18446744073709551615, not 'x'",
                                place + ":2: steps: must be a list of 1 to 1000 steps"));
    }
    EXPECT_THAT(steps(), ElementsAre("1 rescue/front state 1", "2 rescue/front reboot 2"));
}

TEST_F(RigScenarioTest, ShowsHowAListIsWritten) {
    try {
        rig_.apply(of({scanner("front")},
                      "steps: [{sensor: rescue/front, kind: blind, steps: '400,500'}]"));
        FAIL();
    } catch (const sim::LoadError& error) {
        EXPECT_THAT(error.faults(),
                    Contains((directory_.path() / "bad_day.yaml").string() +
                             ":1: steps.1.steps: must be a list of at most 64, in brackets: "
                             "write [400,500]"));
    }
}

TEST_F(RigScenarioTest, IsForScannersAlone) {
    const SensorConfig camera = ideal_camera(4, 25.0);
    const std::string sensor = "rescue/" + camera.name;
    try {
        rig_.apply(
            of({scanner("front"), camera}, "steps: [{sensor: " + sensor + ", kind: reboot}]"));
        FAIL();
    } catch (const sim::LoadError& error) {
        EXPECT_THAT(error.faults(),
                    ElementsAre((directory_.path() / "bad_day.yaml").string() +
                                ":1: steps.1.sensor: there is no scanner '" + sensor +
                                "'; there are \"*\" for every one, rescue/front"));
    }
}

}  // namespace
}  // namespace scipd::daemon
