// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/rig/rig.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include "daemon/device/device.h"
#include "daemon/device/staring_sensor.h"
#include "daemon/faults/fault_injector.h"
#include "daemon/faults/read_fault.h"
#include "daemon/models/model_registry.h"
#include "daemon/plan/rig_plan.h"
#include "daemon/rig/rig_api.h"
#include "daemon/rig/simulation.h"
#include "sim/backends/registry.h"
#include "sim/loaders/file/load_error.h"
#include "tests/daemon/device/ideal_camera.h"
#include "tests/daemon/wall_world.h"
#include "tests/support/scanner_wire.h"
#include "tests/support/temp_dir.h"
#include "tests/support/udp_sender.h"
#include "tests/support/why_not.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using tests::ScannerWire;
using tests::why_not;
namespace fs = std::filesystem;

/// By how many threads sensors live on.
class RigTest : public testing::TestWithParam<std::size_t> {
  protected:
    ~RigTest() override {
        rig_.stop();
        io_.restart();
        io_.run_for(10ms);
    }

    static SensorConfig on_tcp(const std::string& name) {
        SensorConfig sensor = ideal_sensor();
        sensor.name = name;
        sensor.tcp = Address{"127.0.0.1", 0};
        return sensor;
    }

    SensorConfig on_tty(const std::string& name) const {
        SensorConfig sensor = ideal_sensor();
        sensor.name = name;
        sensor.pty = PtyConfig{directory_.path() / name};
        return sensor;
    }

    [[nodiscard]] Config of(std::vector<SensorConfig> sensors,
                            const std::string& robot = "rescue") const {
        Config config;
        config.allow = {SCIPD_SCENES, directory_.path()};
        config.scene = SCIPD_SCENES "/square_room.sdf";
        config.robots.push_back({.name = robot, .sensors = std::move(sensors)});
        return config;
    }

    [[nodiscard]] SensorReport sensor(std::size_t index = 0) const {
        return api_.report().sensors.at(index);
    }

    [[nodiscard]] ScannerWire connect(std::size_t index = 0) const {
        return ScannerWire::tcp(tests::port_of(*sensor(index).tcp));
    }

    bool streams(ScannerWire& wire) {
        const std::uint64_t before = sensor().counts.scans;
        wire.write("MD0540054000000\n");
        return run_until(io_, [&] { return sensor().counts.scans >= before + 3; });
    }

    /// That this model is at the other end.
    bool answers(ScannerWire& wire, const std::string& model) {
        wire.write("VV\n");
        std::string received;
        return run_until(io_, [&] {
            std::array<char, 1024> buffer;
            received.append(buffer.data(), wire.read(buffer, 0ms));
            // Up to the end of the answer.
            return received.find(model) != std::string::npos && received.ends_with("\n\n");
        });
    }

    EditOutcome after(SceneEdit edit) {
        std::optional<EditOutcome> outcome;
        api_.edit_scene(std::move(edit), [&](const EditOutcome& now) { outcome = now; }, {});
        EXPECT_TRUE(run_until(io_, [&] { return outcome.has_value(); }));
        return outcome.value_or(EditOutcome{});
    }

    boost::asio::io_context io_;
    tests::TempDir directory_;
    Rig rig_{io_.get_executor(), ClockKind::wall, nullptr, GetParam()};
    RigApi api_{rig_.simulation()};
};

INSTANTIATE_TEST_SUITE_P(Threads, RigTest, testing::Values(1, 3),
                         testing::PrintToStringParamName());

// A hundred scanners of a rig are not measured a hundred times.
TEST_P(RigTest, MeasuresBackendsOnceForSensorsThatAskAlike) {
    SensorConfig other = on_tcp("other");
    other.model = find_model("URG-04LX");
    rig_.apply(of({on_tcp("a"), on_tcp("b"), other}));
    Simulation& simulation = rig_.simulation();
    const auto choice = [&](const char* sensor) { return simulation.world.choice_of(sensor); };
    simulation.choose_backends();
    ASSERT_TRUE(run_until(io_, [&] { return choice("rescue/other")->faces.has_value(); }));
    EXPECT_TRUE(choice("rescue/a")->faces);
    EXPECT_EQ(choice("rescue/a"), choice("rescue/b"));
    EXPECT_NE(choice("rescue/a"), choice("rescue/other"));
}

std::vector<protocol::Uptime> phases(Rig& rig) {
    std::vector<protocol::Uptime> phases;
    Simulation& simulation = rig.simulation();
    simulation.shards.still([&] {
        for (const auto& station : simulation.stations)
            phases.push_back(std::get<std::unique_ptr<Device>>(station->sensor)->start_of(0));
    });
    return phases;
}

// If all mirrors were in step, all scans would have to be cast at once.
TEST_P(RigTest, SpreadsItsMirrorsOverATurn) {
    std::vector<SensorConfig> sensors;
    for (int i = 0; i < 100; ++i)
        sensors.push_back(on_tcp(std::to_string(i)));
    sensors[7].clock.phase = 12ms;
    sensors[8].clock.phase = 30ms;
    rig_.apply(of(sensors));
    const std::vector<protocol::Uptime> spread = phases(rig_);
    EXPECT_EQ(spread[7], 12ms);
    EXPECT_EQ(spread[8], 30ms % ideal_sensor().model.optics.scan_period);
    for (int quarter = 0; quarter < 4; ++quarter) {
        const auto within = std::ranges::count_if(spread, [&](protocol::Uptime phase) {
            return phase >= quarter * 6250us && phase < (quarter + 1) * 6250us;
        });
        EXPECT_GT(within, 10) << quarter;
    }
    Rig again{io_.get_executor(), ClockKind::wall};
    again.apply(of(sensors));
    EXPECT_EQ(phases(again), spread);
    Rig lockstep{io_.get_executor(), ClockKind::poses};
    lockstep.apply(of({on_tcp("0"), on_tcp("1")}));
    EXPECT_EQ(phases(lockstep), (std::vector<protocol::Uptime>{0ms, 0ms}));
}

TEST_P(RigTest, TellsWhatThereIs) {
    rig_.apply(of({on_tcp("front"), on_tty("rear")}));
    const RigReport report = api_.report();
    ASSERT_EQ(report.sensors.size(), 2U);
    EXPECT_EQ(report.clock, "wall");
    EXPECT_EQ(report.sensors[0].name, "rescue/front");
    EXPECT_EQ(report.sensors[0].model, "UST-10LX");
    EXPECT_EQ(report.sensors[0].backend, "embree");
    EXPECT_EQ(report.sensors[0].state, "standby");
    EXPECT_FALSE(report.sensors[0].pty);
    EXPECT_FALSE(report.sensors[0].counts.lateness.max());
    EXPECT_EQ(report.sensors[1].pty, directory_.path() / "rear");
    EXPECT_FALSE(report.sensors[1].tcp);

    ScannerWire wire = connect();
    ASSERT_TRUE(streams(wire));
    EXPECT_EQ(sensor().state, "streaming");
    EXPECT_EQ(sensor().clients, 1U);
    const Lateness lateness = sensor().counts.lateness;
    ASSERT_TRUE(lateness.max());
    EXPECT_LE(lateness.quantile(0.5), lateness.max());
}

// A pose for each beam of six cameras takes a while to measure; who asks meanwhile comes first.
TEST_P(RigTest, MeasuresBackendsBehindWhatIsAskedForMeanwhile) {
    std::vector<SensorConfig> cameras;
    for (int i = 0; i < 6; ++i) {
        SensorConfig camera = ideal_camera(1000, 8.0);
        camera.name = "c" + std::to_string(i);
        camera.motion = 1000;
        camera.backend = "auto";
        cameras.push_back(camera);
    }
    rig_.apply(of(cameras));
    rig_.simulation().choose_backends();
    const EditOutcome outcome = after(LoadWorld{SCIPD_SCENES "/corridor.sdf"});
    EXPECT_EQ(outcome.result, EditOutcome::Result::done);
    EXPECT_EQ(sensor().backend_reason, "not measured yet");
    const auto measured = [&] {
        return std::ranges::none_of(api_.report().sensors, [](const SensorReport& sensor) {
            return sensor.backend_reason == "not measured yet";
        });
    };
    EXPECT_TRUE(run_until(io_, measured));
    // And not again without a reason: what is settled goes with the sensors.
    Config same = of(cameras);
    same.scene = SCIPD_SCENES "/corridor.sdf";
    rig_.apply(make_plan(same, rig_.running()));
    EXPECT_TRUE(measured());
}

// A picture is drawn where the camera lives, whoever asks for it.
TEST_P(RigTest, ShowsTheLatestOfACameraThatIsWatched) {
    if (sim::find_backend("depth") == nullptr) GTEST_SKIP();
    SensorConfig camera = ideal_camera(20, 50.0);
    camera.name = "camera";
    camera.backend = "depth";
    rig_.apply(of({camera}));
    EXPECT_FALSE(rig_.simulation().known_sensors().at("rescue/camera").sweep);
    EXPECT_TRUE(api_.latest("rescue/camera"));
    Simulation& simulation = rig_.simulation();
    auto& sensor = *std::get<std::unique_ptr<StaringSensor>>(simulation.stations[0]->sensor);
    std::atomic<int> seen = 0;
    simulation.shards.still([&] { sensor.watch([&](const StaringRecord&) { ++seen; }); });
    EXPECT_TRUE(run_until(io_, [&] { return seen > 3; }));
    EXPECT_TRUE(api_.latest("rescue/camera"));
    const int before = seen;
    EXPECT_TRUE(run_until(io_, [&] { return seen > before + 3; }));
    simulation.shards.still([&] { sensor.watch(nullptr); });
    EXPECT_GT(simulation.known_sensors().at("rescue/camera").sweep, 0s);
}

TEST_P(RigTest, TakesAWorldOfAnyKind) {
    Config config = of({on_tcp("front")});
    config.scene = SCIPD_SCENES "/office_map.yaml";
    EXPECT_EQ(make_plan(config).loaded.scene->name, "office_map");
    config.scene = SCIPD_SCENES "/rescue_maze_terrain.obj";
    EXPECT_EQ(make_plan(config).loaded.scene->name, "rescue_maze_terrain");
}

TEST_P(RigTest, LoadsOtherWorldsAndModelsInTheWayOfItsConfiguration) {
    const std::string model =
        "<model name='m'><link name='l'><visual name='seen'><geometry><box><size>1 1 1</size></box>"
        "</geometry></visual><collision name='hit'><geometry><box><size>2 2 2</size></box>"
        "</geometry></collision></link></model>";
    const fs::path world = directory_.write(
        "other.sdf", "<sdf version='1.9'><world name='other'>" + model + "</world></sdf>");
    Config config = of({on_tcp("front")});
    const auto last_object = [&] { return api_.scene().scene->objects.back().name; };
    rig_.apply(config);
    EXPECT_EQ(after(LoadWorld{world}).result, EditOutcome::Result::done);
    EXPECT_EQ(last_object(), "m::l::seen");
    EXPECT_EQ(after(AddModel{.placement = {"n"}, .sdf = model}).result, EditOutcome::Result::done);
    EXPECT_EQ(last_object(), "n::l::seen");

    config.scene = world;
    config.geometry = sim::SdfGeometry::collision;
    config.map.material = "brick";
    rig_.apply(config);
    EXPECT_EQ(after(LoadWorld{world}).result, EditOutcome::Result::done);
    EXPECT_EQ(last_object(), "m::l::hit");
    EXPECT_EQ(after(AddModel{.placement = {"n"}, .sdf = model}).result, EditOutcome::Result::done);
    EXPECT_EQ(last_object(), "n::l::hit");
    EXPECT_EQ(after(LoadWorld{SCIPD_SCENES "/office_map.yaml"}).result, EditOutcome::Result::done);
    EXPECT_EQ(api_.scene().scene->materials.back().name, "brick");
}

TEST_P(RigTest, SaysWhichBodiesAnotherWorldLacks) {
    Config config = of({on_tcp("front")});
    config.robots[0].body = "box";
    rig_.apply(config);
    const std::string lacking = SCIPD_SCENES
        "/corridor.sdf: has no movable model \"box\" to be the body of robot \"rescue\"";
    EXPECT_THAT(after(LoadWorld{SCIPD_SCENES "/corridor.sdf"}).messages,
                testing::ElementsAre(lacking));
    EXPECT_THAT(after(LoadWorld{SCIPD_SCENES "/square_room.sdf"}).messages, testing::IsEmpty());
}

TEST_P(RigTest, KeepsWhatDidNotChange) {
    const SensorConfig front = on_tcp("front");
    rig_.apply(of({front, on_tty("rear")}));
    const std::string address = *sensor().tcp;
    ScannerWire wire = connect();
    ASSERT_TRUE(streams(wire));
    const std::uint64_t scans = sensor().counts.scans;

    rig_.apply(of({front, on_tty("top")}));
    EXPECT_EQ(sensor().tcp, address);
    EXPECT_EQ(sensor().clients, 1U);
    EXPECT_GE(sensor().counts.scans, scans);
    EXPECT_TRUE(run_until(io_, [&] { return sensor().counts.scans > scans + 3; }));
    EXPECT_FALSE(fs::is_symlink(directory_.path() / "rear"));
    EXPECT_TRUE(fs::is_symlink(directory_.path() / "top"));

    // Another seed is another scanner.
    Config reseeded = of({front});
    reseeded.seed = 99;
    rig_.apply(reseeded);
    EXPECT_EQ(sensor().counts.scans, 0U);
    EXPECT_EQ(sensor().clients, 0U);
}

TEST_P(RigTest, ChangesNothingWhereSomethingFails) {
    rig_.apply(of({on_tcp("front")}));
    ScannerWire wire = connect();
    ASSERT_TRUE(streams(wire));
    const std::uint64_t scans = sensor().counts.scans;

    Config lost_world = of({on_tty("rear")});
    lost_world.scene = directory_.path() / "nowhere.sdf";
    EXPECT_THROW(rig_.apply(lost_world), sim::LoadError);

    SensorConfig taken = on_tcp("taken");
    taken.tcp->port = tests::port_of(*sensor().tcp);
    EXPECT_THROW(rig_.apply(of({on_tty("rear"), taken})), std::runtime_error);

    EXPECT_FALSE(fs::is_symlink(directory_.path() / "rear"));
    EXPECT_EQ(api_.report().sensors.size(), 1U);
    EXPECT_TRUE(run_until(io_, [&] { return sensor().counts.scans > scans + 3; }));
}

/// This process opens no more descriptors than so many, as long as this lives.
class FewDescriptors {
  public:
    explicit FewDescriptors(rlim_t more) {
        const int lowest = ::dup(STDIN_FILENO);
        ::close(lowest);
        ::getrlimit(RLIMIT_NOFILE, &before_);
        const rlimit few{static_cast<rlim_t>(lowest) + more, before_.rlim_max};
        ::setrlimit(RLIMIT_NOFILE, &few);
    }
    ~FewDescriptors() { ::setrlimit(RLIMIT_NOFILE, &before_); }
    FewDescriptors(const FewDescriptors&) = delete;
    FewDescriptors& operator=(const FewDescriptors&) = delete;

  private:
    rlimit before_{};
};

TEST_P(RigTest, ChangesNothingWhereDescriptorsRunOutOnTheWay) {
    const SensorConfig kept = on_tcp("kept");
    rig_.apply(of({kept, on_tty("changed"), on_tty("gone")}));
    ScannerWire stream = connect();
    ASSERT_TRUE(streams(stream));
    ScannerWire tty = ScannerWire::tty(directory_.path() / "changed");

    SensorConfig changed = on_tty("changed");
    changed.model = find_model("UTM-30LX");
    Config next = of({kept, changed, on_tty("new"), on_tcp("more")});
    next.robots[0].poses = PoseSource{.address = {"127.0.0.1", 0}, .file = {}};
    const auto try_with = [&](rlim_t more) {
        RigPlan plan = make_plan(next, rig_.running());
        const FewDescriptors few(more);
        try {
            rig_.apply(std::move(plan));
        } catch (const std::exception&) {
            return false;
        }
        return true;
    };
    const auto goes_on = [&] {
        const std::uint64_t scans = sensor().counts.scans;
        return run_until(io_, [&] { return sensor().counts.scans >= scans + 3; });
    };
    rlim_t more = 0;
    for (; !try_with(more); ++more) {
        ASSERT_LT(more, 64U);
        EXPECT_EQ(api_.report().sensors.size(), 3U);
        EXPECT_TRUE(goes_on());
        EXPECT_TRUE(answers(tty, "UST-10LX"));
        EXPECT_TRUE(fs::is_symlink(directory_.path() / "gone"));
        EXPECT_FALSE(fs::is_symlink(directory_.path() / "new"));
    }
    // A listener, a socket for poses, and a tty each with a few.
    EXPECT_GE(more, 5U);
    EXPECT_EQ(api_.report().sensors.size(), 4U);
    EXPECT_TRUE(goes_on());
    EXPECT_THROW(tty.write("VV\n"), std::exception) << "a changed scanner hangs up";
    ScannerWire again = ScannerWire::tty(directory_.path() / "changed");
    EXPECT_TRUE(answers(again, "UTM-30LX"));
    EXPECT_FALSE(fs::is_symlink(directory_.path() / "gone"));
    EXPECT_TRUE(fs::is_symlink(directory_.path() / "new"));
}

TEST_P(RigTest, HandsAPortToAnotherScanner) {
    SensorConfig front = on_tty("tty");
    rig_.apply(of({front}));
    ScannerWire wire = ScannerWire::tty(*sensor().pty);
    const fs::path target = fs::read_symlink(*sensor().pty);

    SensorConfig rear = front;
    rear.name = "rear";
    rear.model = find_model("UTM-30LX");
    rig_.apply(of({rear}));
    EXPECT_NE(fs::read_symlink(*sensor().pty), target);
    EXPECT_THROW(wire.write("VV\n"), std::exception) << "the tty before has hung up";
    ScannerWire again = ScannerWire::tty(*sensor().pty);
    EXPECT_TRUE(answers(again, "UTM-30LX"));
}

TEST_P(RigTest, DoesNotChargeAScannerWithTheLossesOfTheOneBefore) {
    SensorConfig front = on_tty("tty");
    rig_.apply(of({front}));
    ScannerWire wire = ScannerWire::tty(*sensor().pty);
    wire.write("MD0000108000000\n");  // and nobody reads it
    ASSERT_TRUE(run_until(io_, [&] { return sensor().counts.lost > 0; }));
    front.name = "rear";
    rig_.apply(of({front}));
    EXPECT_EQ(sensor().name, "rescue/rear");
    EXPECT_EQ(sensor().counts.lost, 0U);
    Simulation& simulation = rig_.simulation();
    const auto lost_by_port = [&] { return simulation.stations[0]->ports.counts().lost_scans; };
    EXPECT_GT(simulation.shards.still(lost_by_port), 0U);
}

/// Where scanners live, by name.
std::map<std::string, std::size_t> shards_of(Rig& rig) {
    std::map<std::string, std::size_t> shards;
    for (const auto& station : rig.simulation().stations)
        shards[station->name()] = station->shard;
    return shards;
}

// Four scanners in turn on three threads: the first and the last live together.
TEST_P(RigTest, LeavesScannersOnTheirThreadsAndPutsNewOnesWhereThereIsLeastToDo) {
    const std::vector<SensorConfig> all{on_tcp("a"), on_tcp("b"), on_tcp("c"), on_tcp("d")};
    rig_.apply(of(all));
    const auto before = shards_of(rig_);
    rig_.apply(of({all[0], all[3]}));
    EXPECT_EQ(shards_of(rig_).at("rescue/a"), before.at("rescue/a"));
    EXPECT_EQ(shards_of(rig_).at("rescue/d"), before.at("rescue/d"));
    rig_.apply(of({all[0], all[3], on_tcp("e")}));
    EXPECT_EQ(shards_of(rig_).at("rescue/d"), before.at("rescue/d"));
    if (rig_.simulation().shards.size() > 1) {
        EXPECT_NE(shards_of(rig_).at("rescue/e"), before.at("rescue/a"));
    }
}

// Each scanner stays where its tty is, and the other one's port comes to it, on another thread.
TEST_P(RigTest, LetsScannersExchangeTheirPorts) {
    SensorConfig a = on_tty("a");
    SensorConfig b = on_tty("b");
    b.model = find_model("UTM-30LX");
    a.tcp = b.tcp = Address{"127.0.0.1", 0};
    {
        Rig finds_free_ones{io_.get_executor(), ClockKind::wall};
        SensorConfig c = on_tcp("c");
        finds_free_ones.apply(of({c, on_tcp("d")}));
        const RigApi api{finds_free_ones.simulation()};
        a.tcp->port = tests::port_of(*api.report().sensors[0].tcp);
        b.tcp->port = tests::port_of(*api.report().sensors[1].tcp);
    }
    rig_.apply(of({a, b}));
    ScannerWire before = connect(0);
    EXPECT_TRUE(answers(before, "UST-10LX"));

    std::swap(a.tcp, b.tcp);
    rig_.apply(of({a, b}));
    EXPECT_EQ(tests::port_of(*sensor(0).tcp), a.tcp->port);
    ScannerWire to_a = connect(0);
    ScannerWire to_b = connect(1);
    EXPECT_TRUE(answers(to_a, "UST-10LX"));
    EXPECT_TRUE(answers(to_b, "UTM-30LX"));
    ScannerWire tty = ScannerWire::tty(*sensor(1).pty);
    EXPECT_TRUE(answers(tty, "UTM-30LX"));
}

// Without a tty a scanner goes where its port is. It has changed, so its client is cut off.
TEST_P(RigTest, LetsScannersExchangeThePortsThatClientsUse) {
    SensorConfig a = on_tcp("a");
    SensorConfig b = on_tcp("b");
    b.model = find_model("UTM-30LX");
    rig_.apply(of({a, b}));
    for (SensorConfig* sensor : {&a, &b})
        sensor->tcp->port = tests::port_of(*this->sensor(sensor == &a ? 0 : 1).tcp);
    rig_.stop();
    Rig rig{io_.get_executor(), ClockKind::wall, nullptr, GetParam()};
    const RigApi api{rig.simulation()};
    rig.apply(of({a, b}));
    ScannerWire before = ScannerWire::tcp(a.tcp->port);
    EXPECT_TRUE(answers(before, "UST-10LX"));
    std::swap(a.tcp, b.tcp);
    rig.apply(make_plan(of({a, b}), rig.running()));
    ScannerWire to_a = ScannerWire::tcp(a.tcp->port);
    EXPECT_TRUE(answers(to_a, "UST-10LX"));
    ScannerWire to_b = ScannerWire::tcp(b.tcp->port);
    EXPECT_TRUE(answers(to_b, "UTM-30LX"));
    rig.stop();
}

TEST_P(RigTest, HandsAPortOnWithoutTheFaultsOfTheScannerBefore) {
    Config config = of({on_tty("tty")});
    config.scenario =
        directory_.write("bad_day.yaml", "steps: [{sensor: '*', kind: delay, ms: 1}]\n");
    rig_.apply(config);
    ScannerWire wire = ScannerWire::tty(*sensor().pty);
    EXPECT_TRUE(answers(wire, "UST-10LX"));

    // The line of the new scanner is not that which the end of the old one's fault brings back.
    config.scenario.clear();
    config.robots[0].sensors[0].link.latency = 100ms;
    rig_.apply(config);
    ScannerWire again = ScannerWire::tty(*sensor().pty);
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_TRUE(answers(again, "UST-10LX"));
    EXPECT_GE(std::chrono::steady_clock::now() - begin, 200ms);
}

TEST_P(RigTest, MovesRobotsForTheControlApi) {
    rig_.apply(of({on_tcp("front")}));
    EXPECT_FALSE(api_.robot_pose("nobody"));
    EXPECT_EQ(api_.robot_pose("rescue")->pose, sim::Pose{});
    const sim::Pose there = sim::pose_from_rpy({1, 2, 0}, {0, 0, 0});
    EXPECT_TRUE(api_.set_robot_pose("rescue", {.pose = there}));
    EXPECT_EQ(api_.robot_pose("rescue")->pose, there);
    EXPECT_EQ(api_.report().poses.accepted, 1U);
    // Stamps of the sender begin anywhere but must grow.
    const sim::PoseLine stamped{.time = 500s, .pose = there};
    EXPECT_TRUE(api_.set_robot_pose("rescue", stamped));
    EXPECT_EQ(why_not(api_.set_robot_pose("rescue", stamped)),
              "t: not later than the pose before it");
    EXPECT_EQ(api_.report().poses.refused, 1U);
}

TEST_P(RigTest, KeepsThePoseFeedsThatStay) {
    const tests::UdpSender sender;
    Config config = of({on_tcp("front")});
    PoseSource source;
    source.address = Address{"127.0.0.1", sender.port()};
    config.robots[0].poses = source;
    rig_.apply(config);
    sender.send(R"({"xyz":[1,0,0]})");
    EXPECT_TRUE(run_until(io_, [&] { return api_.report().poses.accepted == 1; }));
    config.seed = 5;
    rig_.apply(config);
    sender.send(R"({"xyz":[2,0,0]})");
    EXPECT_TRUE(run_until(io_, [&] { return api_.report().poses.accepted == 2; }));
    EXPECT_GE(api_.robot_pose("rescue")->pose.translation_m.x, 2.0) << "it goes on as it moved";

    config.robots[0].poses.reset();
    rig_.apply(config);
    sender.send(R"({"xyz":[3,0,0]})");
    io_.restart();
    io_.run_for(50ms);
    EXPECT_EQ(api_.report().poses.accepted, 2U);
}

// To each robot its own.
TEST_P(RigTest, KeepsThePortsForPosesThatTheSystemChose) {
    Config config = of({on_tcp("front")}, "a");
    config.robots[0].poses = PoseSource{.address = {"127.0.0.1", 0}, .file = {}};
    rig_.apply(config);
    const Address of_a = rig_.pose_addresses().at("a");
    EXPECT_NE(of_a.port, 0);
    config.robots.push_back(config.robots[0]);
    config.robots[1].name = "b";
    rig_.apply(config);
    EXPECT_EQ(rig_.pose_addresses().at("a"), of_a);
    EXPECT_NE(rig_.pose_addresses().at("b").port, of_a.port);
    config.robots[1].poses.reset();
    rig_.apply(config);
    EXPECT_EQ(rig_.pose_addresses().size(), 1U);
}

TEST_P(RigTest, HandsAPoseAddressOnToARenamedRobot) {
    const tests::UdpSender sender;
    PoseSource source;
    source.address = Address{"127.0.0.1", sender.port()};
    Config config = of({on_tcp("front")});
    config.robots[0].poses = source;
    rig_.apply(config);
    config.robots[0].name = "transport";
    rig_.apply(config);
    sender.send(R"({"xyz":[1,0,0]})");
    EXPECT_TRUE(run_until(io_, [&] { return api_.report().poses.accepted == 1; }));
    EXPECT_EQ(api_.robot_pose("transport")->pose.translation_m.x, 1.0);
    EXPECT_FALSE(api_.robot_pose("rescue"));
}

TEST_P(RigTest, LeavesNothingBehind) {
    rig_.apply(of({on_tcp("front"), on_tty("rear")}));
    rig_.stop();
    EXPECT_TRUE(api_.report().sensors.empty());
    EXPECT_FALSE(fs::is_symlink(directory_.path() / "rear"));
    // Nothing is waited for any more.
    EXPECT_TRUE(run_until(io_, [&] { return io_.stopped(); }));
}

}  // namespace
}  // namespace scipd::daemon
