// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a command line means, and the literal words for one that is wrong.
#include <sstream>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/config/config_file.h"
#include "daemon/models/model_registry.h"
#include "daemon/plan/load_world.h"
#include "daemon/program/parse_options.h"
#include "tests/support/backend_names.h"
#include "tests/support/temp_dir.h"

namespace scipd::daemon {
namespace {

using testing::HasSubstr;

/// As a shell would cut it at blanks.
std::variant<Options, Answer> parse(const std::string& line) {
    std::istringstream words{"scipd " + line};
    std::vector<std::string> storage;
    for (std::string word; words >> word;)
        storage.push_back(word);
    std::vector<const char*> arguments;
    for (const auto& word : storage)
        arguments.push_back(word.c_str());
    return parse_options(static_cast<int>(arguments.size()), arguments.data());
}

Options run(const std::string& line) {
    const auto parsed = parse(line);
    if (const auto* answer = std::get_if<Answer>(&parsed)) {
        throw std::runtime_error("an answer: " + answer->text);
    }
    return std::get<Options>(parsed);
}

Answer answer(const std::string& line) {
    const auto parsed = parse(line);
    if (std::holds_alternative<Options>(parsed)) throw std::runtime_error("no answer");
    return std::get<Answer>(parsed);
}

const SensorConfig& sensor(const Options& options) {
    return options.config.robots.at(0).sensors.at(0);
}

class OptionsTest : public testing::Test {
  protected:
    OptionsTest() { dir_.write("room.sdf", room("<box><size>1 1 1</size></box>")); }

    /// What is told of the materials of scipd. Of one UST-20LX: its noise is that of a UST-10LX,
    /// its bias and its light have no source either.
    static std::string stock() {
        return summary_of(*load_materials(Config{}).library) +
               ", error curves: 3, 100 % of them assumed";
    }

    /// A world of one line and one model.
    static std::string room(const std::string& geometry, const std::string& more = {}) {
        return "<sdf version='1.9'><world name='w'><model name='m'><link name='l'>"
               "<visual name='v'><geometry>" +
               geometry + "</geometry>" + more + "</visual></link></model></world></sdf>";
    }

    std::string scene() const { return "--scene " + (dir_.path() / "room.sdf").string() + " "; }

    tests::TempDir dir_;
};

TEST_F(OptionsTest, TakesFreePortsBesideAConfiguration) {
    const std::string yaml = R"({scene: room.sdf, robots: {a: {sensors: {
        both: {model: UST-10LX, tcp: "0.0.0.0:10940", pty: /tmp/urg},
        tty: {model: URG-04LX, pty: auto},
        ranger: {ranger: {cone_deg: 1, beams: 1, rate_hz: 1, range_m: [0.1, 1]}}}}}})";
    const auto file = dir_.write("rig.yaml", yaml);
    const auto sensors = run("--free-ports --config " + file.string()).config.robots.at(0).sensors;
    ASSERT_EQ(sensors.size(), 3U);
    for (const SensorConfig& one : sensors) {
        EXPECT_EQ(one.tcp.has_value(), one.name != "ranger");
        EXPECT_EQ(one.tcp.value_or(Address{"127.0.0.1", 0}), (Address{"127.0.0.1", 0}));
        EXPECT_FALSE(one.pty);
    }
}

TEST_F(OptionsTest, WithoutAnyIsAScannerInTheMaze) {
    const Options options = run("");
    const Config& config = options.config;
    EXPECT_EQ(config.scene.filename(), "rescue_maze.sdf");
    EXPECT_TRUE(std::filesystem::exists(config.scene));
    EXPECT_EQ(config.seed, 1u);
    EXPECT_EQ(config.control, "");
    EXPECT_EQ(config.http, std::nullopt);
    EXPECT_EQ(options.config_file, std::nullopt);
    EXPECT_EQ(options.log_level, "info");

    ASSERT_EQ(config.robots.size(), 1u);
    const RobotConfig& robot = config.robots[0];
    EXPECT_EQ(robot.name, "robot");
    // Where scenes/rescue_maze.sdf says that it starts.
    EXPECT_EQ(robot.world_from_robot, sim::pose_from_rpy({1.0, 1.0, 0.0}, {0.0, 0.0, 0.0}));
    EXPECT_EQ(robot.poses, std::nullopt);

    ASSERT_EQ(robot.sensors.size(), 1u);
    SensorConfig expected;
    expected.name = "scanner";
    expected.model = find_model("UST-10LX");
    expected.robot_from_sensor = sim::pose_from_rpy({0.0, 0.0, 0.25}, {0.0, 0.0, 0.0});
    expected.tcp = Address{"127.0.0.1", 10940};
    expected.pty = PtyConfig{};
    EXPECT_EQ(robot.sensors[0], expected);
}

TEST_F(OptionsTest, AnotherSceneStartsAtItsOrigin) {
    const Options options = run(scene());
    EXPECT_EQ(options.config.scene, dir_.path() / "room.sdf");
    EXPECT_EQ(options.config.robots[0].world_from_robot, sim::Pose{});
    EXPECT_EQ(sensor(options).robot_from_sensor, sim::Pose{});
}

TEST_F(OptionsTest, EachOptionHasItsPlace) {
    const std::string base = scene();
    EXPECT_EQ(sensor(run(base + "--model URG-04LX@3.1.04")).model, find_model("URG-04LX@3.1.04"));
    EXPECT_EQ(sensor(run(base + "--tcp [::1]:0")).tcp, (Address{"::1", 0}));
    EXPECT_EQ(sensor(run(base + "--tcp none")).tcp, std::nullopt);
    EXPECT_EQ(sensor(run(base + "--pty none")).pty, std::nullopt);
    EXPECT_EQ(sensor(run(base + "--pty auto")).pty, PtyConfig{});
    EXPECT_EQ(sensor(run(base + "--pty /run/x")).pty, PtyConfig{"/run/x"});
    EXPECT_EQ(sensor(run(base + "--pty x")).pty, PtyConfig{std::filesystem::current_path() / "x"});
    EXPECT_EQ(sensor(run(base + "--backend reference")).backend, "reference");
    EXPECT_EQ(sensor(run(base + "--accuracy ideal")).accuracy, sim::Accuracy::ideal);
    EXPECT_EQ(sensor(run(base + "--timing ideal")).timing, Timing::ideal);
    EXPECT_EQ(sensor(run(base)).power_up, PowerUp::scip2);
    EXPECT_EQ(sensor(run(base + "--power-up boot")).power_up, PowerUp::boot);
    EXPECT_EQ(sensor(run(base + "--power-up scip1.1 --model URG-04LX")).power_up, PowerUp::scip1);
    EXPECT_EQ(sensor(run(base + "--mount 0.1,0,0.2,0,0,3")).robot_from_sensor,
              sim::pose_from_rpy({0.1, 0.0, 0.2}, {0.0, 0.0, 3.0}));
    EXPECT_EQ(sensor(run(base + "--name tank/top")).name, "top");
    EXPECT_EQ(run(base + "--name tank/top").config.robots[0].name, "tank");
    EXPECT_EQ(run(base + "--seed 18446744073709551615").config.seed, ~std::uint64_t{0});
    EXPECT_EQ(run(base + "--control /run/c").config.control, "/run/c");
    EXPECT_EQ(run(base + "--http 127.0.0.1:8080").config.http, (Address{"127.0.0.1", 8080}));
    EXPECT_EQ(run(base + "--http none").config.http, std::nullopt);
    EXPECT_EQ(run(base + "--clock wall").config, run(base).config);
    EXPECT_EQ(run(base + "--log-level debug").log_level, "debug");
    EXPECT_EQ(run(base).log_format, "text");
    EXPECT_EQ(run(base + "--log-format json").log_format, "json");
    EXPECT_EQ(run(base + "--log-level warning").log_level, "warning");  // as log lines have it
}

TEST_F(OptionsTest, AMountMayBeNamed) {
    const auto named = run(scene() + "--mount m::l");
    EXPECT_EQ(sensor(named).mount, (NamedMount{.kind = MountKind::any, .name = "m::l"}));
    EXPECT_FALSE(named.config.robots[0].pose_given);
    EXPECT_TRUE(run(scene() + "--mount m::l --pose 1,2,0").config.robots[0].pose_given);
    NamedMount lidar{.kind = MountKind::lidar, .name = "m::l::s", .chooses_model = true};
    EXPECT_EQ(sensor(run(scene() + "--sensor-from m::l::s")).mount, lidar);
    // What the user says counts, on whichever side.
    lidar.chooses_model = false;
    EXPECT_EQ(sensor(run(scene() + "--sensor-from m::l::s --model URG-04LX")).mount, lidar);
    EXPECT_EQ(sensor(run(scene() + "--model URG-04LX --sensor-from m::l::s")).mount, lidar);
    // Which model it will be is not known yet.
    EXPECT_EQ(sensor(run(scene() + "--sensor-from s --power-up scip1.1")).power_up, PowerUp::scip1);
    EXPECT_THAT(answer(scene() + "--sensor-from s --mount l").text, HasSubstr("--mount"));
}

TEST_F(OptionsTest, APoseMayBeginWithAMinus) {
    EXPECT_EQ(run("--pose -1,2,-0.5").config.robots[0].world_from_robot,
              sim::pose_from_rpy({-1.0, 2.0, 0.0}, {0.0, 0.0, -0.5}));
    EXPECT_EQ(run("--pose=-1,2,3,+0.1,0.2,1e-3").config.robots[0].world_from_robot,
              sim::pose_from_rpy({-1.0, 2.0, 3.0}, {0.1, 0.2, 1e-3}));
}

TEST_F(OptionsTest, PosesComeFromThreeKindsOfSources) {
    using Kind = PoseSource::Kind;
    const auto source = [](const std::string& line) {
        return run(line).config.robots[0].poses.value();
    };
    EXPECT_EQ(source("--poses -").kind, Kind::standard_input);
    EXPECT_EQ(source("--poses udp:127.0.0.1:9").kind, Kind::udp);
    EXPECT_EQ(source("--poses udp:127.0.0.1:9").address, (Address{"127.0.0.1", 9}));
    const auto walk = dir_.write("walk.tum", "");
    EXPECT_EQ(source("--poses " + walk.string()).kind, Kind::file);
    EXPECT_EQ(source("--poses " + walk.string()).file, walk);
}

TEST_F(OptionsTest, AConfigurationSaysWhatOptionsDoNot) {
    const auto file = dir_.write("one.yaml",
                                 "scene: room.sdf\n"
                                 "robots: {r: {sensors: {s: {model: UST-20LX, pty: auto}}}}\n");
    const Options options = run("--log-level warn --config " + file.string());
    EXPECT_EQ(options.config, load_config(file));
    EXPECT_EQ(options.config_file, file);
    EXPECT_EQ(options.log_level, "warn");

    EXPECT_EQ(answer("--list-models --check x").exit_code, 2);
}

TEST_F(OptionsTest, HoldInPlaceOfWhatAConfigurationSays) {
    const auto file = dir_.write("one.yaml",
                                 "scene: room.sdf\nseed: 5\nclock: wall\ncontrol: a.sock\n"
                                 "http: 127.0.0.1:8080\nfleet: {broker: 'mqtt://a', world: b}\n"
                                 "robots: {r: {sensors: {s: {model: UST-20LX, pty: auto}}}}\n");
    const auto other = dir_.write("more/other.sdf", "");
    const Config said =
        run("--config " + file.string() + " --scene " + other.string() +
            " --seed 3 --clock poses --control b.sock --http none --strict --world c")
            .config;
    EXPECT_EQ(said.scene, other);
    EXPECT_EQ(said.seed, 3U);
    EXPECT_EQ(said.clock, ClockKind::poses);
    EXPECT_EQ(said.control.filename(), "b.sock");
    EXPECT_FALSE(said.http);
    EXPECT_TRUE(said.strict);
    EXPECT_EQ(said.fleet->broker.host, "a");
    EXPECT_EQ(said.fleet->world, "c");
    // Its clients may name files beside the world that there is.
    EXPECT_THAT(said.allow, testing::Contains(other.parent_path()));
}

TEST_F(OptionsTest, OfAScannerAreRefusedBesideAConfiguration) {
    const auto refused = [&](const std::string& option, const std::string& key) {
        const Answer both = answer(option + " --config x.yaml");
        EXPECT_EQ(both.exit_code, 2);
        EXPECT_EQ(both.text, "scipd: " + option.substr(0, option.find(' ')) +
                                 " is for a scanner without a configuration: beside --config, "
                                 "write " +
                                 key + " into the file\n");
    };
    refused("--model UST-10LX", "robots.ROBOT.sensors.SENSOR.model");
    refused("--power-up boot", "robots.ROBOT.sensors.SENSOR.power_up");
    refused("--pose 1,2,3", "robots.ROBOT.pose");
    refused("--name a/b", "robots.ROBOT.sensors.SENSOR");
    refused("--sensor-from a", "robots.ROBOT.sensors.SENSOR.mount.sensor");
    EXPECT_EQ(answer("--config x.yaml --check y.yaml").text,
              "scipd: --config and --check do not go together\n");
    EXPECT_THAT(answer("--broker mqtt://a " + scene()).text, HasSubstr("go together"));
}

TEST_F(OptionsTest, NamesMaterials) {
    const auto file = dir_.write("mine.yaml", "materials: {}\n");
    EXPECT_EQ(run("--materials " + file.string()).config.materials, file);
    EXPECT_TRUE(run("").config.materials.empty());
}

TEST_F(OptionsTest, SayHowAWorldIsRead) {
    const auto file =
        dir_.write("xacro.yaml",
                   "scene: room.sdf\nxacro: {angle: 10, rear: true}\ngeometry: visual\n"
                   "robots: {r: {sensors: {s: {model: UST-20LX, pty: auto}}}}\n");
    const std::string arguments = "--xacro angle:=40 --xacro name:=my_lidar --geometry collision ";
    const Config config = run(arguments + "--config " + file.string()).config;
    EXPECT_EQ(config.xacro,
              (sim::XacroArguments{{"angle", "40"}, {"name", "my_lidar"}, {"rear", "true"}}));
    EXPECT_EQ(config.geometry, sim::SdfGeometry::collision);
    EXPECT_EQ(run(arguments).config.xacro,
              (sim::XacroArguments{{"angle", "40"}, {"name", "my_lidar"}}));
    for (const std::string wrong : {"angle", "angle=40", ":=40", "angle:=", "a:=b:=c"}) {
        EXPECT_EQ(answer("--xacro " + wrong).exit_code, 2) << wrong;
        EXPECT_THAT(answer("--xacro " + wrong).text, HasSubstr("--xacro")) << wrong;
    }
}

TEST_F(OptionsTest, SayHowACheckedWorldIsRead) {
    const auto world = dir_.write(
        "collisions.sdf",
        "<sdf version='1.9'><world name='w'><model name='m'><link name='l'><collision name='c'>"
        "<geometry><box><size>1 1 1</size></box></geometry></collision></link></model></world>"
        "</sdf>");
    const std::string check = "--check " + world.string();
    EXPECT_THAT(answer(check).text, HasSubstr("--geometry collision"));
    EXPECT_THAT(answer(check).text, HasSubstr("objects: 0"));
    EXPECT_THAT(answer(check + " --geometry collision").text, HasSubstr("objects: 1"));
    EXPECT_THAT(answer(check + " --geometry collision --xacro a:=1").text,
                HasSubstr("is not written in xacro; the xacro arguments are ignored"));
    EXPECT_EQ(answer(check + " --geometry collision --xacro a:=1 --strict").exit_code, 2);
}

TEST_F(OptionsTest, CheckTellsAllFaultsOrNone) {
    const auto whole = dir_.write("whole.yaml",
                                  "scene: room.sdf\n"
                                  "robots: {r: {sensors: {s: {model: UST-20LX, pty: auto}}}}\n");
    EXPECT_EQ(answer("--check " + whole.string()).exit_code, 0);
    EXPECT_EQ(answer("--check " + whole.string()).text,
              whole.string() +
                  ": no errors; robots: 1, sensors: 1, models: 1, materials: " + stock() + "\n");

    const auto broken = dir_.write("broken.yaml", "scene: room.sdf\nrobot: {}\nseed: x\n");
    EXPECT_EQ(answer("--check " + broken.string()).exit_code, 2);
    EXPECT_EQ(answer("--check " + broken.string()).text,
              broken.string() + ":1: needs at least one robot, under robots\n" + broken.string() +
                  ":2: robot: unknown key; did you mean robots?\n" + broken.string() +
                  ":3: seed: must be a whole number from 0 to 18446744073709551615, not 'x'\n");
    EXPECT_EQ(answer("--config " + broken.string()).text,
              answer("--check " + broken.string()).text);
}

TEST_F(OptionsTest, CheckReadsTheWorldToo) {
    const auto file = dir_.write("rig.yaml",
                                 "scene: bad.sdf\n"
                                 "robots: {r: {sensors: {s: {model: UST-20LX, pty: auto}}}}\n");
    const auto bad = dir_.write("bad.sdf", room("<box><size>1 0 1</size></box>"));
    EXPECT_EQ(answer("--check " + file.string()).exit_code, 2);
    const std::string size = ":1: m::l::v: every size must be above 0 and at most 1e7 m";
    EXPECT_THAT(
        answer("--check " + file.string()).text,
        testing::StartsWith(file.string() + ":1: scene: " + bad.string() + size + "; left out\n"));
    EXPECT_EQ(answer("--strict --check " + file.string()).text,
              file.string() + ":1: scene: " + bad.string() + size + "\n");
    dir_.write("bad.sdf",
               "<sdf version='1.9'><world name='w'><include><uri>model://sun</uri></include>"
               "<include><uri>model://ground_plane</uri></include><population name='a'/>"
               "</world></sdf>");
    EXPECT_EQ(answer("--check " + file.string()).exit_code, 0);
    EXPECT_EQ(answer("--check " + file.string()).text,
              bad.string() + ":1: a: has no <model>; left out\n" + file.string() +
                  ": no errors; robots: 1, sensors: 1, models: 1, materials: " + stock() + "\n");
    EXPECT_EQ(answer("--check " + file.string() + " --strict").exit_code, 2);
    EXPECT_TRUE(run("--strict " + scene()).config.strict);
    EXPECT_FALSE(run(scene()).config.strict);
}

TEST_F(OptionsTest, CheckSaysWhereLaserRetroCountsForNothing) {
    const auto world = dir_.write(
        "bright.sdf", room("<box><size>1 1 1</size></box>", "<laser_retro>2000</laser_retro>"));
    const auto check = [&](const std::string& accuracy) {
        return answer("--check " +
                      dir_.write("rig.yaml",
                                 "scene: bright.sdf\nrobots: {r: {sensors: {s: {model: "
                                 "UST-20LX, pty: auto, accuracy: " +
                                     accuracy + "}}}}\n")
                          .string())
            .text;
    };
    const std::string line = world.string() +
                             " defines laser_retro values, but they have no effect: no scanner "
                             "uses `accuracy: material`\n";
    EXPECT_THAT(check("sensor"), testing::HasSubstr(line));
    EXPECT_THAT(check("material"), testing::Not(testing::HasSubstr("laser_retro")));
}

TEST_F(OptionsTest, CheckSaysWhereMaterialsOfAWorldCountForNothing) {
    const auto world = [&](const std::string& material) {
        dir_.write("named.sdf", room("<box><size>1 1 1</size></box>",
                                     "<scipd:material xmlns:scipd='urn:scipd:sdf'>" + material +
                                         "</scipd:material>"));
        return answer("--check " + dir_.write("named.yaml",
                                              "scene: named.sdf\nrobots: {r: {sensors: {s: "
                                              "{model: UST-20LX, pty: auto}}}}\n")
                                       .string())
            .text;
    };
    EXPECT_THAT(world("glass"), testing::HasSubstr(" defines materials, but "));
    EXPECT_THAT(world("Made/Up"), testing::Not(testing::HasSubstr(" defines materials, but ")));
}

TEST_F(OptionsTest, CheckSaysWhereErrorsAreOfARecording) {
    const auto recording = dir_.write("scans.csv", "1000 2000\n1000 2000\n");
    const std::string text =
        answer("--check " + dir_.write("played.yaml",
                                       "robots: {r: {sensors: {s: {model: UST-20LX, pty: auto, "
                                       "replay: scans.csv, noise: 2}}}}\n")
                                .string())
            .text;
    EXPECT_THAT(text, testing::HasSubstr("noise: a recording has the errors of its own scanner"));
}

TEST_F(OptionsTest, CheckTellsFaultsOfTheWorldAndOfTrajectories) {
    const auto file = dir_.write("rig.yaml",
                                 "scene: bad.sdf\n"
                                 "robots: {r: {poses: drive.tum, sensors: {s: {model: UST-20LX, "
                                 "pty: auto}}}}\n");
    dir_.write("bad.sdf", room("<box><size>1 0 1</size></box>"));
    dir_.write("drive.tum", "1 0 0 0 0 0 0 1\n0 0 0 0 0 0 0 1\n");
    EXPECT_EQ(answer("--check " + file.string()).exit_code, 2);
    EXPECT_THAT(answer("--check " + file.string()).text,
                testing::AllOf(testing::HasSubstr(file.string() + ":1: scene: " +
                                                  dir_.path().string() + "/bad.sdf:1: "),
                               testing::HasSubstr(file.string() + ":2: robots.r.poses: " +
                                                  dir_.path().string() + "/drive.tum:2: ")));
}

TEST_F(OptionsTest, CheckTellsWhatIsLeftOutOfTrajectories) {
    const auto file = dir_.write("rig.yaml",
                                 "scene: room.sdf\n"
                                 "robots: {r: {poses: {from: drive.txt, format: csv}, sensors: {s: "
                                 "{model: UST-20LX, pty: auto}}}}\n");
    const auto drive = dir_.write("drive.txt", "t,x,y,yaw,v\n0,0,0,0,1\n0,0,0,0,1\n");
    EXPECT_EQ(answer("--check " + file.string()).exit_code, 0);
    EXPECT_THAT(answer("--check " + file.string()).text,
                testing::StartsWith(drive.string() + ": the column 'v' is not read\n" +
                                    drive.string() + ":3: has the stamp of the pose before it"));
}

TEST_F(OptionsTest, CheckMakesFaultsOfWarningsOfTrajectoriesWhereItIsStrict) {
    const auto file = dir_.write("rig.yaml",
                                 "scene: room.sdf\nstrict: true\n"
                                 "robots: {r: {poses: {from: drive.txt, format: csv}, sensors: {s: "
                                 "{model: UST-20LX, pty: auto}}}}\n");
    const auto drive = dir_.write("drive.txt", "t,x,y,yaw,v\n0,0,0,0,1\n1,0,0,0,1\n");
    EXPECT_EQ(answer("--check " + file.string()).exit_code, 2);
    EXPECT_EQ(
        answer("--check " + file.string()).text,
        file.string() + ":3: robots.r.poses: " + drive.string() + ": the column 'v' is not read\n");
    dir_.write("drive.txt", "t,x,y,yaw\n0,0,0,0\n1,0,0,0\n");
    EXPECT_EQ(answer("--check " + file.string()).exit_code, 0);
}

TEST_F(OptionsTest, RunsAScenarioWhateverTheConfigurationSays) {
    const auto other = dir_.write("other.yaml", "steps: [{sensor: r/s, kind: reboot}]\n");
    const auto file = dir_.write("rig.yaml",
                                 "scene: room.sdf\nscenario: bad_day.yaml\n"
                                 "robots: {r: {sensors: {s: {model: UST-20LX, pty: auto}}}}\n");
    const auto named = dir_.write("bad_day.yaml", "steps:\n- {sensor: r/x, kind: reboot}\n");
    EXPECT_EQ(run("--config " + file.string()).config.scenario, named);
    EXPECT_EQ(answer("--check " + file.string()).exit_code, 2);
    EXPECT_EQ(answer("--check " + file.string()).text,
              file.string() + ":2: scenario: " + named.string() +
                  ":2: steps.1.sensor: there is no scanner 'r/x'; there are \"*\" for every one, "
                  "r/s\n");
    const std::string scenario = " --scenario " + other.string();
    EXPECT_EQ(run("--config " + file.string() + scenario).config.scenario, other);
    EXPECT_EQ(run(scene() + scenario).config.scenario, other);
    EXPECT_TRUE(run(scene()).config.scenario.empty());
    EXPECT_EQ(answer("--check " + file.string() + scenario).exit_code, 0);
    dir_.write("other.yaml", "steps: 3\n");
    EXPECT_EQ(answer("--check " + file.string() + scenario).text,
              other.string() + ":1: steps: must be a list of 1 to 1000 steps\n");
}

TEST_F(OptionsTest, HasAPageWhateverTheConfigurationSays) {
    const auto silent = dir_.write("silent.yaml",
                                   "scene: room.sdf\n"
                                   "robots: {r: {sensors: {s: {model: UST-20LX, pty: auto}}}}\n");
    const auto open = dir_.write("open.yaml",
                                 "scene: room.sdf\nhttp: 127.0.0.1:8080\n"
                                 "robots: {r: {sensors: {s: {model: UST-20LX, pty: auto}}}}\n");
    const auto http = [](const std::string& line) { return run(line).config.http; };
    EXPECT_EQ(http("--config " + silent.string()), std::nullopt);
    EXPECT_EQ(http("--config " + silent.string() + " --http 127.0.0.1:0"),
              (Address{"127.0.0.1", 0}));
    EXPECT_EQ(http("--config " + open.string()), (Address{"127.0.0.1", 8080}));
    EXPECT_EQ(http("--config " + open.string() + " --http 127.0.0.1:0"), (Address{"127.0.0.1", 0}));
    EXPECT_EQ(http("--config " + open.string() + " --http none"), std::nullopt);
    EXPECT_EQ(answer("--http 127.0.0.1:0 --check " + silent.string()).exit_code, 0);
}

TEST_F(OptionsTest, CheckTellsWhereABodyIsMissing) {
    const auto file = dir_.write("rig.yaml",
                                 "scene: room.sdf\n"
                                 "robots:\n  r:\n    body: hull\n"
                                 "    sensors: {s: {model: UST-20LX, pty: auto}}\n");
    EXPECT_EQ(answer("--check " + file.string()).exit_code, 2);
    EXPECT_EQ(answer("--check " + file.string()).text,
              file.string() + ":4: robots.r.body: " + (dir_.path() / "room.sdf").string() +
                  " has no movable model \"hull\"; movable models are m\n");
}

TEST(Options, AnswersQuestionsOnStandardOutput) {
    EXPECT_EQ(answer("--list-models").exit_code, 0);
    EXPECT_THAT(answer("--list-models").text, testing::StartsWith("MODEL  "));
    EXPECT_THAT(answer("--list-models").text, HasSubstr("\nUST-10LX@2.23.0000      Ethernet     "));
    const Answer backends = answer("--list-backends");
    EXPECT_EQ(backends.exit_code, 0);
    for (const std::string& name : tests::backend_names())
        EXPECT_THAT('\n' + backends.text, HasSubstr('\n' + name));
    EXPECT_EQ(answer("--version").exit_code, 0);
    EXPECT_THAT(answer("--version").text, testing::StartsWith("scipd 0."));
    EXPECT_EQ(answer("--help").exit_code, 0);
    for (const char* said : {"Examples:", "--scene", "--poses", "--list-models", "Exit codes"})
        EXPECT_THAT(answer("--help").text, HasSubstr(said));
}

TEST(Options, SaysInOneSentenceWhatIsWrong) {
    const std::pair<const char*, std::string> table[] = {
        {"--scene /nowhere.sdf", "--scene: there is no file '/nowhere.sdf'"},
        {"--scene /no/where/in/a/folder/with/a/long/name.sdf",
         "--scene: there is no file '/no/where/in/a/folder/with/a/long/name.sdf'"},
        {"--materials /nowhere.yaml", "--materials: there is no file '/nowhere.yaml'"},
        {"--scenario /nowhere.yaml", "--scenario: there is no file '/nowhere.yaml'"},
        {"--poses /", "--poses: '/' is a directory; name a file"},
        {"--scene /dev/zero", "--scene: '/dev/zero' is a device; name a file"},
        {"--poses /dev/zero", "--poses: '/dev/zero' is a device; name a file"},
        {"--tcp 10940",
         "--tcp: must be ADDRESS:PORT such as 127.0.0.1:10940, [::1]:10940 or localhost:0, not "
         "'10940'"},
        {"--tcp none --pty none", "--tcp none and --pty none: no driver could reach the scanner"},
        {"--name robot", "--name: must be ROBOT/SENSOR, such as rescue/front, not 'robot'"},
        {"--name a/..",
         "--name: '..' is no name: use up to 64 letters, digits, _ - and ., not beginning with a "
         "dot"},
        {"--pose 1,2", "--pose: must be X,Y,YAW or X,Y,Z,ROLL,PITCH,YAW, not '1,2'"},
        {"--pose 1,2,x", "--pose: must be a number, not 'x'"},
        {"--pose 1,nan,2", "--pose: must be a number, not 'nan'"},
        {"--mount 0,0,inf,0,0,0", "--mount: must be a number, not 'inf'"},
        {"--mount 0.1,0,0.2",
         "--mount: must be X,Y,Z,ROLL,PITCH,YAW or a name, not '0.1,0,0.2'; for X,Y,Z write "
         "0.1,0,0.2,0,0,0"},
        {"--mount 1,2", "--mount: must be X,Y,Z,ROLL,PITCH,YAW or a name, not '1,2'"},
        {"--pose 1,,2", "--pose: must be a number, not ''"},
        {"--clock pose", "--clock: must be wall or poses, not 'pose'"},
        {"--accuracy fine", "--accuracy: must be ideal, sensor or material, not 'fine'"},
        {"--backend radar",
         "--backend: this build has no backend 'radar'; use auto, " + tests::listed_backends()},
        {"--power-up cold", "--power-up: must be scip2.0, scip1.1 or boot, not 'cold'"},
        {"--power-up scip1.1 --model UST-20LX",
         "--power-up: UST-20LX never spoke SCIP 1.1; use scip2.0 or boot"},
        {"--threads 0", "--threads: must be a whole number from 1 to 1024, not '0'"},
        {"--seed 1.5", "--seed: must be a whole number from 0 to 18446744073709551615, not '1.5'"},
    };
    for (const auto& [line, sentence] : table) {
        const Answer refused = answer(line);
        EXPECT_EQ(refused.exit_code, 2) << line;
        EXPECT_EQ(refused.text, "scipd: " + sentence + "\n");
    }
    for (const char* line : {"--tcp", "--seed 1 --seed 2", "--log-level x", "--log-format xml"})
        EXPECT_EQ(answer(line).exit_code, 2) << line;
}

TEST(Options, NamesTheOptionThatSomebodyMeant) {
    const std::pair<const char*, const char*> table[] = {
        {"--sceen x", "there is no option --sceen; did you mean --scene?"},
        {"--seed 2 --treads=3", "there is no option --treads; did you mean --threads?"},
        {"--radar", "there is no option --radar; see scipd --help"},
        {"rig.yaml", "unexpected argument 'rig.yaml'; see scipd --help"},
        // Names in other programs; --port is also near to --pose, and --noise too.
        {"--port 10940", "there is no option --port; did you mean --tcp ADDR:PORT?"},
        {"--noise=2",
         "there is no option --noise; did you mean --accuracy ideal|sensor|material, or `scipctl "
         "sensor set noise=2` for a factor?"},
        {"--device /tmp/urg", "there is no option --device; did you mean --pty LINK?"},
    };
    for (const auto& [line, sentence] : table) {
        EXPECT_EQ(answer(line).exit_code, 2) << line;
        EXPECT_EQ(answer(line).text, "scipd: " + std::string(sentence) + "\n");
    }
}

TEST_F(OptionsTest, NamesTheOptionThatAFileNeeds) {
    const auto room = (dir_.path() / "room.sdf").string();
    const auto lap = dir_.write("lap.tum", "1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n").string();
    const auto rig =
        dir_.write("rig.yaml", "robots: {r: {sensors: {s: {model: UST-10LX, pty: auto}}}}\n")
            .string();
    const auto day = dir_.write("day.yaml", "steps: [{sensor: r/s, kind: reboot}]\n").string();
    const std::pair<std::string, std::string> table[] = {
        {room, "--scene " + room},
        {rig, "--config " + rig},
        {lap, "--poses " + lap},
        {day, "--scenario " + day},
        {"scans.mcap", "--replay scans.mcap"},
    };
    for (const auto& [file, option] : table) {
        EXPECT_EQ(answer(file).exit_code, 2);
        const std::string text = answer(file).text;
        EXPECT_THAT(text, testing::StartsWith("scipd: unexpected argument '"));
        EXPECT_THAT(text, testing::EndsWith("'; did you mean " + option + "?\n"));
    }
    EXPECT_EQ(answer("--config " + room).text, "scipd: --config: '" + room +
                                                   "' is not a configuration; did you mean "
                                                   "--scene " +
                                                   room + "?\n");
    EXPECT_EQ(
        answer("--world " + room).text,
        "scipd: --world: names a shared world, not a file; did you mean --scene " + room + "?\n");
    EXPECT_THAT(answer("--replay " + lap).text,
                HasSubstr("lap.tum' is a trajectory, not a recording; a robot follows it by its "
                          "poses (--poses)\n"));
    EXPECT_THAT(answer("--model ust-10lx").text,
                HasSubstr("there is no model \"ust-10lx\"; did you mean UST-10LX? The models are "
                          "URG-04LX, "));
}

TEST(Options, WhatOtherMachinesReachNeedsATokenThatOptionsCannotSay) {
    const Answer refused = answer("--http 0.0.0.0:8080");
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.text, testing::StartsWith("scipd: --http: other machines reach 0.0.0.0"));
}

TEST(Options, AWorldIsSharedByWayOfABroker) {
    const auto fleet = run("--broker mqtt://[::1]:2000 --world hall").config.fleet;
    ASSERT_TRUE(fleet);
    EXPECT_EQ(fleet->broker, (BrokerAddress{"::1", 2000, false}));
    EXPECT_EQ(fleet->world, "hall");
    EXPECT_THAT(answer("--broker mqtt://127.0.0.1").text,
                HasSubstr("--broker and --world go together"));
    EXPECT_THAT(answer("--world hall").text, HasSubstr("--broker and --world go together"));
    EXPECT_THAT(answer("--broker http://a --world w").text, HasSubstr("must be mqtt://HOST:PORT"));
}

TEST(Options, ASocketPathMustFitTheSystem) {
    EXPECT_EQ(answer("--control /" + std::string(200, 'x')).text,
              "scipd: --control: must be shorter: a socket's path has at most 107 bytes, this has "
              "201\n");
}

}  // namespace
}  // namespace scipd::daemon
