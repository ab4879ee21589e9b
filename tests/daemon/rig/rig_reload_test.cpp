// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What leaves with a configuration, while something is under way to it and faults act.
#include <array>
#include <chrono>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "daemon/faults/read_fault.h"
#include "daemon/plan/rig_plan.h"
#include "daemon/rig/rig.h"
#include "daemon/rig/rig_api.h"
#include "daemon/rig/simulation.h"
#include "sim/backends/registry.h"
#include "sim/loaders/file/load_error.h"
#include "tests/daemon/wall_world.h"
#include "tests/support/scanner_wire.h"
#include "tests/support/temp_dir.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using tests::ScannerWire;

/// What a client sends is on its way for so long.
constexpr auto latency = 100ms;

bool can_use(const std::string& backend) {
    try {
        (void)sim::make_backend(backend, std::make_shared<const sim::Scene>());
        return true;
    } catch (const std::runtime_error&) {
        return false;
    }
}

/// By how many threads sensors live on, and by what casts for them.
class RigReloadTest : public testing::TestWithParam<std::tuple<std::size_t, std::string>> {
  protected:
    void SetUp() override {
        if (!can_use(backend_)) GTEST_SKIP() << "this machine has no " << backend_;
        rig_.apply(of("a"));
        client_ = std::make_unique<ScannerWire>(connect());
        ask("BM\n");
        const auto fault = parse_fault(R"({"kind":"motor","percent":5})");
        (void)api_.faults().start("a/scanner", fault.value());
    }
    ~RigReloadTest() override {
        rig_.stop();
        io_.restart();
        io_.run_for(10ms);
    }

    /// One scanner on a robot of this name.
    [[nodiscard]] Config of(const std::string& robot) const {
        SensorConfig sensor = ideal_sensor();
        sensor.tcp = Address{"127.0.0.1", 0};
        sensor.backend = backend_;
        sensor.link.latency = latency;
        Config config;
        config.scene = SCIPD_SCENES "/square_room.sdf";
        config.robots.push_back({.name = robot, .sensors = {sensor}});
        return config;
    }

    [[nodiscard]] ScannerWire connect() const {
        return ScannerWire::tcp(tests::port_of(*api_.report().sensors.at(0).tcp));
    }
    /// A request with an answer.
    void ask(const std::string& request) {
        client_->write(request);
        ASSERT_TRUE(comes("\n\n"));
    }
    bool comes(const std::string& end) {
        std::string received;
        return run_until(io_, [&] {
            std::array<char, 4096> buffer;
            received.append(buffer.data(), client_->read(buffer, 0ms));
            return received.find(end) != std::string::npos;
        });
    }

    /// Half of its way to the scanner.
    void send_a_request() {
        client_->write("GD0540054000\n");
        io_.restart();
        io_.run_for(latency / 2);
    }
    /// Has `act` meet a scanner whose client asks for a scan in the same moment.
    template <class Act>
    void while_a_request_arrives(Act act) {
        send_a_request();
        rig_.simulation().shards.still([&] {
            std::this_thread::sleep_for(latency);
            act();
        });
    }

    std::string backend_ = std::get<1>(GetParam());
    boost::asio::io_context io_;
    Rig rig_{io_.get_executor(), ClockKind::wall, nullptr, std::get<0>(GetParam())};
    RigApi api_{rig_.simulation()};
    std::unique_ptr<ScannerWire> client_;
};

INSTANTIATE_TEST_SUITE_P(Threads, RigReloadTest,
                         testing::Combine(testing::Values(1, 3),
                                          testing::Values("embree", "depth")),
                         [](const auto& info) {
                             return std::get<1>(info.param) + "_" +
                                    std::to_string(std::get<0>(info.param));
                         });

// The end of a fault has the scanner look at what has come meanwhile.
TEST_P(RigReloadTest, EndsAScannerWhoseRobotGetsAnotherName) {
    RigPlan plan = make_plan(of("b"), rig_.running());
    while_a_request_arrives([&] { rig_.apply(std::move(plan)); });
    client_ = std::make_unique<ScannerWire>(connect());
    ask("BM\n");
    ask("GD0540054000\n");
    EXPECT_EQ(api_.report().sensors.at(0).name, "b/scanner");
}

TEST_P(RigReloadTest, EndsAScannerThatGoes) {
    Config empty = of("a");
    empty.robots.clear();
    RigPlan plan = make_plan(empty, rig_.running());
    while_a_request_arrives([&] { rig_.apply(std::move(plan)); });
    EXPECT_TRUE(api_.report().sensors.empty());
}

TEST_P(RigReloadTest, EndsAScannerWithTheDaemon) {
    send_a_request();
    std::this_thread::sleep_for(latency);
    rig_.stop();
    EXPECT_TRUE(api_.report().sensors.empty());
}

// What draws for a scanner is bound to the scanner's thread.
TEST_P(RigReloadTest, LetsAFaultEndWhereItsScannerLives) {
    while_a_request_arrives([&] { api_.faults().stop_all("a/scanner"); });
    EXPECT_TRUE(comes("GD0540054000\n00P\n"));
    ask("GD0540054000\n");
}

TEST_P(RigReloadTest, LetsAScenarioBeginAndEndWhereItsScannersLive) {
    const Scenario scenario =
        parse_scenario("steps: [{sensor: '*', kind: motor, percent: 7}]", "bad_day", {});
    while_a_request_arrives([&] { api_.faults().run(scenario); });
    EXPECT_TRUE(comes("GD0540054000\n00P\n"));
    while_a_request_arrives([&] { api_.faults().stop_scenario(); });
    EXPECT_TRUE(comes("GD0540054000\n00P\n"));
}

// All sensors stand still while a plan is taken up, and a large file takes seconds.
TEST(RigPlanTest, HoldsAllThatFilesTell) {
    const tests::TempDir directory;
    Config config;
    config.scene = directory.write("empty.sdf", R"(<sdf version="1.9"><world name="w"/></sdf>)");
    config.materials = directory.write(
        "materials.yaml", "materials:\n  cheese: {reflectance: {905: 0.7}, assumed: true}\n");
    config.scenario = directory.write(
        "bad_day.yaml", "steps: [{sensor: '*', kind: reboot, at: {scan: 900000000}}]\n");
    SensorConfig sensor = ideal_sensor();
    sensor.tcp = Address{"127.0.0.1", 0};
    config.robots.push_back({.name = "rescue", .sensors = {sensor}});
    PoseSource& drive = config.robots[0].poses.emplace();
    drive.kind = PoseSource::Kind::file;
    drive.file = directory.write("drive.tum", "1 5 0 0 0 0 0 1\n9 5 0 0 0 0 0 1\n");
    boost::asio::io_context io;
    Rig rig(io.get_executor(), ClockKind::wall);
    RigPlan plan = make_plan(config, rig.running());
    for (const auto& file : {config.scene, config.materials, config.scenario, drive.file})
        std::filesystem::remove(file);
    rig.apply(std::move(plan));
    RigApi api(rig.simulation());
    EXPECT_EQ(api.robot_pose("rescue")->pose.translation_m.x, 5.0);
    EXPECT_EQ(api.faults().scenario()->state, "running");

    // What is played already is not read again.
    config.scene = SCIPD_SCENES "/square_room.sdf";
    config.materials.clear();
    config.scenario.clear();
    rig.apply(make_plan(config, rig.running()));
    EXPECT_THROW((void)make_plan(config), sim::LoadError);
    rig.stop();
}

}  // namespace
}  // namespace scipd::daemon
