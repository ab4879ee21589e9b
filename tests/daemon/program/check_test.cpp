// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The answers of `scipd --check` about files that are no configuration, with figures that were
// counted by hand.
#include "daemon/program/check.h"

#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/loaders/file/load_error.h"
#include "tests/support/temp_dir.h"

namespace scipd::daemon {
namespace {

using testing::AllOf;
using testing::Each;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* triangle = "v 0 0 0\nv 3 0 0\nv 0 4 1\nf 1 2 3\n";

class CheckFile : public testing::Test {
  protected:
    /// What it says of a file of this name and content, without the folder.
    std::string said(const std::string& name, const std::string& content, bool strict = false) {
        dir_.write(name, content);
        return said_of(name, strict);
    }

    std::string said_of(const std::string& name, bool strict = false) {
        std::string text;
        Options options;
        options.overrides.strict = strict;
        try {
            text = check(dir_.path() / name, options);
        } catch (const sim::LoadError& error) {
            text = std::string("refused: ") + error.what();
        }
        const std::string folder = dir_.path().string() + "/";
        for (auto at = text.find(folder); at != text.npos; at = text.find(folder))
            text.erase(at, folder.size());
        return text;
    }

    static std::string world(const std::string& geometry) {
        return "<sdf version='1.9'><world name='w'><model name='m'><static>true</static>"
               "<link name='l'><visual name='v'><geometry>" +
               geometry + "</geometry></visual></link></model></world></sdf>";
    }

    tests::TempDir dir_;
};

TEST_F(CheckFile, CountsAWorld) {
    EXPECT_EQ(
        said("room.sdf", world("<box><size>2 3 1</size></box>")),
        "room.sdf: no errors; a world; models: 1, objects: 1, triangles of meshes: 0, size: 2 "
        "x 3 x 1 m from (-1 -1.5 -0.5), materials: default\n");
    const std::string bad = world(
        "<box><size>2 0 1</size></box></geometry></visual><visual name='w'><geometry>"
        "<box><size>2 3 1</size></box>");
    EXPECT_THAT(said("bad.sdf", bad),
                AllOf(StartsWith("bad.sdf:1: m::l::v: every size must be above 0"),
                      HasSubstr("\nbad.sdf: no errors; a world; models: 1, objects: 1, ")));
    EXPECT_THAT(said("bad.sdf", bad, true), StartsWith("refused: bad.sdf:1: m::l::v: every size"));
    EXPECT_THAT(said("torn.sdf", "<sdf"), StartsWith("refused: torn.sdf"));
}

TEST_F(CheckFile, CountsAMesh) {
    EXPECT_THAT(
        said("ramp.obj", triangle),
        StartsWith("ramp.obj: no errors; a mesh; models: 1, objects: 1, triangles of meshes: "
                   "1, size: 3 x 4 x 1 m from (0 0 0)"));
    EXPECT_THAT(said("big.obj", "v 0 0 0\nv 3000 0 0\nv 0 4000 1\nf 1 2 3\n"),
                HasSubstr("big.obj: is very large; if it is in millimetres"));
    EXPECT_THAT(said("torn.stl", "solid"), StartsWith("refused: torn.stl"));
}

TEST_F(CheckFile, CountsAMap) {
    dir_.write("hall.pgm", "P2\n4 2\n255\n0 0 255 255\n255 255 255 0\n");
    const std::string map =
        "image: hall.pgm\nresolution: 0.5\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\n"
        "free_thresh: 0.2\n";
    EXPECT_THAT(said("hall.yaml", map),
                AllOf(StartsWith("hall.yaml: no errors; a ROS map; models: 1, objects: "),
                      HasSubstr("size: 2 x 1 x 2 m from (0 0 0)")));
    EXPECT_THAT(said("torn.yaml", "image: none.pgm\nresolution: 0\norigin: [0, 0, 0]\n"),
                AllOf(StartsWith("refused: torn.yaml:"), HasSubstr("resolution")));
}

TEST_F(CheckFile, RefusesOptionsOfWorldsForOtherFiles) {
    const auto refusal = [&](const std::string& name, const std::string& content) {
        dir_.write(name, content);
        std::vector<std::string> refusals;
        for (const bool of_xacro : {true, false}) {
            Options options;
            if (of_xacro) options.overrides.xacro = {{"naem", "x"}};
            if (!of_xacro) options.overrides.geometry = sim::SdfGeometry::collision;
            try {
                refusals.push_back(check(dir_.path() / name, options));
            } catch (const sim::LoadError& error) {
                refusals.emplace_back(error.what());
            }
        }
        return refusals;
    };
    for (const auto& [name, content] : std::vector<std::pair<std::string, std::string>>{
             {"lap.tum", "0 0 0 0 0 0 0 1\n1 3 4 0 0 0 0 1\n"},
             {"materials.yaml", "materials:\n  cork: {reflectivity: 0.3}\n"},
             {"scenario.yaml", "steps:\n- {sensor: a/b, kind: reboot}\n"}}) {
        EXPECT_THAT(refusal(name, content),
                    Each(EndsWith(name + ": is no world: leave --xacro and --geometry out")));
    }
}

TEST_F(CheckFile, TakesAModelOfGazebo) {
    EXPECT_THAT(said("box.model", world("<box><size>2 3 1</size></box>")),
                StartsWith("box.model: no errors; a world; models: 1, objects: 1, "));
}

TEST_F(CheckFile, SaysWhatAnotherWorldInYamlIs) {
    EXPECT_THAT(said("cafe.yaml", "properties: {}\nlayers:\n- {name: map, map: cafe.yaml}\n"),
                HasSubstr("looks like a world of Flatland"));
    EXPECT_THAT(said("clinic.building.yaml", "levels: {L1: {}}\nname: clinic\n"),
                HasSubstr("looks like a building of Open-RMF"));
}

TEST_F(CheckFile, CountsATrajectory) {
    const std::string lap = "0 0 0 0 0 0 0 1\n1 3 4 0 0 0 0 1\n2 3 5 0 0 0 0 1\n";
    const std::string figures =
        "poses: 3, duration: 2.000 s, rate: 1 Hz, path: 6 m, fastest: 5 m/s\n";
    EXPECT_EQ(said("lap.tum", lap), "lap.tum: no errors; a trajectory (TUM); " + figures);
    EXPECT_EQ(said("lap.txt", "# a lap\n" + lap),
              "lap.txt: no errors; a trajectory (TUM); " + figures);
    EXPECT_EQ(said("lap.csv", "t,x,y,yaw\n0,0,0,0\n1,3,4,0\n2,3,5,0\n"),
              "lap.csv: no errors; a trajectory (CSV); " + figures);
    EXPECT_THAT(said("leap.tum", "0 0 0 0 0 0 0 1\n1 500 0 0 0 0 0 1\n"),
                EndsWith("fastest: 500 m/s, jumps: 1\n"));
    EXPECT_EQ(said("one.tum", "0 0 0 0 0 0 0 1\n"),
              "one.tum: no errors; a trajectory (TUM); poses: 1, duration: 0.000 s\n");
    EXPECT_THAT(said("back.tum", "1 0 0 0 0 0 0 1\n0 0 0 0 0 0 0 1\n"),
                StartsWith("refused: back.tum:2: "));
    const std::string more = "t,x,y,yaw,v\n0,0,0,0,1\n1,3,4,0,1\n";
    EXPECT_THAT(said("more.csv", more),
                StartsWith("more.csv: the column 'v' is not read\nmore.csv: "));
    EXPECT_EQ(said("more.csv", more, true), "refused: more.csv: the column 'v' is not read");
}

TEST_F(CheckFile, CountsAScenario) {
    EXPECT_EQ(said("bad_day.yaml",
                   "seed: 7\nsteps:\n- {sensor: r/front, kind: reboot}\n"
                   "- {sensor: '*', kind: freeze, for: {scans: 5}}\n"),
              "bad_day.yaml: no errors; a scenario; steps: 2, seed: 7, kinds: freeze, reboot, "
              "scanners: *, r/front\n");
    EXPECT_THAT(
        said("torn.yaml", "steps:\n- {sensor: front, kind: reboot}\n- {sensor: a/b, kind: x}\n"),
        AllOf(HasSubstr("torn.yaml:2: steps.1.sensor: must be ROBOT/SENSOR, or \"*\" for every "
                        "scanner, not 'front'"),
              HasSubstr("torn.yaml:3: steps.2.kind: there is no kind 'x'")));
}

TEST_F(CheckFile, CountsMaterials) {
    EXPECT_EQ(said("mine.yaml", "materials: {cork: {reflectance: {905: 0.5}, assumed: [905]}}\n"),
              "mine.yaml: no errors; materials: 1 with 1 parameters, 100 % of them assumed (not "
              "measured)\n");
    EXPECT_THAT(said("torn.yaml", "materials: {cork: {reflectance: {905: 7}}}\n"),
                StartsWith("refused: torn.yaml:1: "));
}

TEST_F(CheckFile, StillTakesAConfigurationByAnyName) {
    dir_.write("room.sdf", world("<box><size>2 3 1</size></box>"));
    const std::string config =
        "scene: room.sdf\nrobots: {r: {sensors: {s: {model: UST-10LX, pty: auto}}}}\n";
    for (const char* name : {"rig.yaml", "rig.conf", "rig"})
        EXPECT_THAT(said(name, config), HasSubstr(": no errors; robots: 1, sensors: 1, models: 1"));
    EXPECT_THAT(said("typo.yaml", "robot: {}\n"),
                HasSubstr("typo.yaml:1: robot: unknown key; did you mean robots?"));
    EXPECT_THAT(said("torn.yaml", "robots: [\n"), HasSubstr("torn.yaml:2: not YAML: "));
    EXPECT_THAT(said("empty.yaml", ""), HasSubstr("needs at least one robot"));
}

TEST_F(CheckFile, ListsWhatThereCouldBe) {
    const std::string list =
        "is not a file type that scipd knows. Known are: a configuration, a scenario, ";
    EXPECT_THAT(said("compose.yaml", "services: {web: {image: nginx}}\n"),
                StartsWith("refused: compose.yaml: " + list));
    EXPECT_THAT(said("notes.txt", "Dear diary,\ntoday 3 robots\n"),
                StartsWith("refused: notes.txt: " + list));
    EXPECT_THAT(said("photo.png", std::string("\x89PNG\0\0", 6)),
                StartsWith("refused: photo.png: " + list));
    EXPECT_EQ(said_of("nowhere.sdf"), "refused: nowhere.sdf: no such file");
}

}  // namespace
}  // namespace scipd::daemon
