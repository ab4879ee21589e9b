// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Actors as Gazebo's users write them: where they walk, what is seen of them, and what is said of
// those that are faulty.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/backends/registry.h"
#include "sim/loaders/scene_file.h"
#include "sim/loaders/sdf/sdf.h"
#include "sim/world/script.h"
#include "tests/sim/backends/contract.h"
#include "tests/sim/loaders/faults_of.h"
#include "tests/sim/loaders/sdf/sdf_text.h"

namespace scipd::sim {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

/// A block of 0.5 m by 0.5 m that stands on z = `low` and is `high` m high.
std::string block(double low, double high) {
    std::string text;
    for (const double z : {low, low + high}) {
        for (const auto* xy : {"-0.25 -0.25", "0.25 -0.25", "0.25 0.25", "-0.25 0.25"})
            text += std::string("v ") + xy + ' ' + std::to_string(z) + '\n';
    }
    return text + "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
}

std::string waypoint(const std::string& time, const std::string& pose) {
    return "<waypoint><time>" + time + "</time><pose>" + pose + "</pose></waypoint>\n";
}

std::string trajectory(const std::string& inside, const std::string& attributes = "") {
    return "<trajectory id='0' type='walking' " + attributes + ">\n" + inside + "</trajectory>";
}

/// 1 m/s along x at y = 0, from x = 0 to x = 6, a waypoint each metre.
std::string along_x(double z_m = 0.0) {
    std::string text;
    for (int i = 0; i <= 6; ++i) {
        const std::string n = std::to_string(i);
        text += waypoint(n, n + " 0 " + std::to_string(z_m) + " 0 0 0");
    }
    return trajectory(text);
}

std::string actor(const std::string& inside, const std::string& name = "walker") {
    return "<actor name='" + name + "'>\n" + inside + "\n</actor>\n";
}

std::string script(const std::string& inside) {
    return "<script>" + inside + "</script>";
}

const std::string skin = "<skin><filename>skin.obj</filename></skin>";

class SdfActors : public ::testing::Test {
  protected:
    SdfActors() { folder_.write("skin.obj", block(0, 1.7)); }

    void load(const std::string& text, const SdfOptions& options = {}) {
        auto loaded = load_sdf(folder_.write("a.sdf", text), options);
        scene_ = std::move(loaded.scene);
        warnings_ = std::move(loaded.warnings);
        backend_ = make_backend("reference", scene_);
    }

    [[nodiscard]] const Model& model(const std::string& name = "walker") const {
        return scene_->models.at(find_model(*scene_, name).value());
    }

    /// At that time of its script.
    [[nodiscard]] Pose pose(Time time, const std::string& name = "walker") const {
        return model(name).script->at(0s, time);
    }

    void put_walker(Time time) { backend_->move(*find_model(*scene_, "walker"), pose(time)); }

    /// From there along +x.
    float ahead_m(const glm::dvec3& from) {
        const glm::vec3 direction{1, 0, 0};
        const Pose here{from, {1, 0, 0, 0}};
        Hit hit;
        backend_->cast({.directions = {&direction, 1}, .world_from_sensor = {&here, 1}}, {&hit, 1});
        return hit.range_m;
    }

    /// Less the place that each begins with.
    [[nodiscard]] std::vector<std::string> warnings() const {
        std::vector<std::string> all;
        const std::string file = (folder_.path() / "a.sdf").string();
        for (const std::string& warning : warnings_) {
            EXPECT_THAT(warning, StartsWith(file));
            all.push_back(warning.substr(std::min(file.size(), warning.size())));
        }
        return all;
    }

    TempDir folder_;
    SharedScene scene_;
    std::vector<std::string> warnings_;
    std::unique_ptr<RangeBackend> backend_;
};

TEST_F(SdfActors, AreMovableModelsThatWalk) {
    load(world(actor(skin + script(along_x()))));
    EXPECT_THAT(warnings(), IsEmpty());
    EXPECT_TRUE(model().movable);
    EXPECT_EQ(model().world_from_model, Pose{});
    for (const Time time : {1s, 3s, 5s}) {
        put_walker(time);
        // Its face is half its depth before it.
        EXPECT_NEAR(ahead_m({-2, 0, 0.5}), 2.0 + std::chrono::duration<double>(time).count() - 0.25,
                    1e-6);
    }
    EXPECT_NEAR(pose(9s).translation_m.x, 3.0, 1e-9);  // a loop is the default
}

TEST_F(SdfActors, AreSeenByAllBackendsAlike) {
    load(world(actor(skin + script(along_x())) + model_of(visual("v", unit_box))));
    for (const std::string& backend : backend_names()) {
        if (!what_lacks(backend).empty()) continue;
        backend_ = make_backend(backend, scene_);
        put_walker(4s);
        EXPECT_NEAR(ahead_m({1, 0, 0.2}), 2.75, 1e-3) << backend;
    }
}

TEST_F(SdfActors, ShowTheirLinksToo) {
    load(world(actor("<link name='l'><pose>0 0 0.5 0 0 0</pose>" + visual("v", unit_box) +
                     "</link>" + script(along_x()))));
    EXPECT_THAT(warnings(), IsEmpty());
    ASSERT_EQ(scene_->objects.size(), 1U);
    EXPECT_EQ(scene_->objects[0].name, "walker::l::v");
    EXPECT_NEAR(ahead_m({-2, 0, 0.5}), 1.5, 1e-6);
}

TEST_F(SdfActors, HaveSkinsOfTheScaleThatTheyWant) {
    load(world(actor("<skin><filename>skin.obj</filename><scale>2</scale></skin>")));
    EXPECT_NEAR(ahead_m({-2, 0, 3.3}), 1.5, 1e-6);
    EXPECT_EQ(ahead_m({-2, 0, 3.5}), nothing);
}

// The origin of Gazebo Classic's walk.dae lies at the hips: at z = 0 its feet are meant, at z = 1
// (Gazebo Sim, and plugins) its hips.
TEST_F(SdfActors, StandOnTheGround) {
    for (const double origin : {0.0, -0.95}) {
        for (const double z : {0.0, 0.95}) {
            folder_.write("skin.obj", block(origin, 1.75));
            load(world(actor(skin + script(along_x(z)))));
            EXPECT_NEAR(ahead_m({-2, 0, 0.1}), 1.75, 1e-6) << origin << ' ' << z;
            EXPECT_NEAR(ahead_m({-2, 0, 1.65}), 1.75, 1e-6) << origin << ' ' << z;
            EXPECT_EQ(ahead_m({-2, 0, 1.85}), nothing) << origin << ' ' << z;
        }
    }
}

TEST_F(SdfActors, AreCapsulesWhereTheirSkinCannotBeRead) {
    const std::string stands_in =
        "; a capsule of a person's size, 1.75 m high and 0.5 m wide, stands in";
    folder_.write("broken.dae", "<COLLADA>");
    for (const std::string file : {"none.dae", "broken.dae", "motion.bvh"}) {
        load(world(actor("<skin><filename>" + file + "</filename></skin>" + script(along_x()))));
        EXPECT_THAT(warnings(), ElementsAre(testing::AllOf(HasSubstr("walker::skin::skin: "),
                                                           testing::EndsWith(stands_in))));
        EXPECT_NEAR(ahead_m({-2, 0, 0.5}), 1.75, 1e-3);
        EXPECT_EQ(ahead_m({-2, 0, 1.8}), nothing);
        EXPECT_NEAR(pose(3s).translation_m.x, 3.0, 1e-9);
    }
    load(world(actor(script(along_x()))));
    EXPECT_THAT(warnings(), ElementsAre(HasSubstr(": has no <skin>" + stands_in)));
    EXPECT_NEAR(ahead_m({-2, 0, 0.5}), 1.75, 1e-3);
}

TEST_F(SdfActors, StandWithoutAScriptOrWhereItIsNotToStart) {
    const std::string pose = "<pose>3 0 0 0 0 0</pose>";
    for (const std::string& more : {std::string{}, script("<loop>true</loop>"),
                                    script("<auto_start>false</auto_start>" + along_x())}) {
        load(world(actor(pose + skin + more)));
        EXPECT_THAT(warnings(), IsEmpty());
        EXPECT_EQ(model().script, nullptr);
        EXPECT_TRUE(model().movable);
        EXPECT_NEAR(ahead_m({0, 0, 0.5}), 2.75, 1e-6);
    }
    load(world(actor(pose + skin + "<plugin name='p' filename='libwalk.so'/>")));
    EXPECT_THAT(warnings(),
                ElementsAre(":5: actor 'walker' is moved by a <plugin> in Gazebo and stands here, "
                            "until poses move it"));
}

TEST_F(SdfActors, WaitAndWalkOnceWhereTheyAreToldTo) {
    load(world(
        actor(skin + script("<loop>false</loop><delay_start>2.5</delay_start>" + along_x()))));
    EXPECT_DOUBLE_EQ(pose(2500ms).translation_m.x, 0.0);
    EXPECT_NEAR(pose(5500ms).translation_m.x, 3.0, 1e-9);
    EXPECT_NEAR(pose(100s).translation_m.x, 6.0, 1e-9);
}

TEST_F(SdfActors, TakeTheirTrajectoriesByIdAndTheirWaypointsByTime) {
    const std::string second =
        "<trajectory id='7' type='a'>" + waypoint("0", "9 0 0 0 0 0") + "</trajectory>";
    const std::string first = "<trajectory id='3' type='a'>\n" + waypoint("2", "2 0 0 0 0 0") +
                              waypoint("0", "0 0 0 0 0 0") + waypoint("1", "1 0 0 0 0 0") +
                              "</trajectory>";
    load(world(actor(skin + script("<loop>0</loop>" + second + first))));
    EXPECT_THAT(
        warnings(),
        ElementsAre(HasSubstr("actor 'walker' has waypoints whose times go back; scipd sorts them "
                              "by time")));
    EXPECT_NEAR(pose(1s).translation_m.x, 1.0, 1e-9);
    EXPECT_NEAR(pose(3s).translation_m.x, 9.0, 1e-9);
}

TEST_F(SdfActors, ReadPosesInDegreesAndQuaternions) {
    load(world(actor(skin + script(trajectory(
                                "<waypoint><time>0</time><pose degrees='true'>1 2 0 0 0 90</pose>"
                                "</waypoint><waypoint><time>1</time><pose rotation_format="
                                "'quat_xyzw'>1 2 0  0 0 0.7071068 0.7071068</pose></waypoint>")))));
    EXPECT_THAT(warnings(), IsEmpty());
    for (const Time time : {0s, 1s})
        EXPECT_LT(angle_between_rad(pose(time).rotation,
                                    pose_from_rpy({}, {0, 0, std::acos(0.0)}).rotation),
                  1e-6);
}

// As people write them: the pose is that of the first waypoint.
TEST_F(SdfActors, HaveWaypointsInTheWorld) {
    const std::string two = waypoint("0", "5 1 0 0 0 0") + waypoint("9", "6 1 0 0 0 0");
    load(world(actor("<pose>5 1 0 0 0 1</pose>" + skin + script(trajectory(two)))));
    EXPECT_THAT(warnings(), IsEmpty());
    EXPECT_DOUBLE_EQ(pose(0s).translation_m.x, 5.0);
    EXPECT_EQ(model().world_from_model, pose(0s));
    load(world(actor("<pose>1 1 0 0 0 1</pose>" + skin + script(trajectory(two)))));
    EXPECT_THAT(warnings(),
                ElementsAre(HasSubstr("in Gazebo Sim they are relative to its <pose>")));
    EXPECT_DOUBLE_EQ(pose(0s).translation_m.x, 5.0);
}

// Where it was as the world was saved says nothing of its script.
TEST_F(SdfActors, BeginTheirScriptInASavedWorldToo) {
    load(world(actor(skin + script(along_x())) +
               "<state world_name='w'><model name='walker'><pose>4.5 0 0 0 0 1</pose>"
               "<scale>1 1 1</scale></model></state>"));
    EXPECT_EQ(model().world_from_model, Pose{});
    EXPECT_NEAR(pose(3s).translation_m.x, 3.0, 1e-9);
}

class IncludedActors : public SdfActors {
  protected:
    IncludedActors() {
        folder_.write("models/man/model.config",
                      "<?xml version='1.0'?><model><name>man</name><version>1.0</version>"
                      "<sdf version='1.6'>model.sdf</sdf></model>");
        folder_.write(
            "models/man/model.sdf",
            "<?xml version='1.0'?>\n<sdf version='1.6'>" +
                actor("<skin><filename>meshes/skin.obj</filename></skin>" + script(along_x()),
                      "man") +
                "</sdf>");
        folder_.write("models/man/meshes/skin.obj", block(0, 1.7));
    }
};

TEST_F(IncludedActors, WalkFromWhereTheyArePut) {
    load(
        world("<include><uri>model://man</uri></include>"
              "<include><uri>model://man</uri><name>walker</name>"
              "<pose>10 2 0 0 0 1.5707963267948966</pose></include>"));
    EXPECT_THAT(warnings(), IsEmpty());
    EXPECT_NEAR(pose(3s, "man").translation_m.x, 3.0, 1e-9);
    EXPECT_NEAR(pose(3s).translation_m.x, 10.0, 1e-9);
    EXPECT_NEAR(pose(3s).translation_m.y, 5.0, 1e-9);
    EXPECT_EQ(scene_->objects.size(), 2U);
}

TEST_F(IncludedActors, CanBeAddedToAWorldThatIsThere) {
    const auto file = folder_.path() / "models/man/model.sdf";
    const Pose there = pose_from_rpy({10, 2, 0}, {0, 0, std::acos(0.0)});
    const auto loaded = load_model({.placement = {"walker", there}, .file = file});
    scene_ = with_models(Scene{}, *loaded.scene);
    EXPECT_NEAR(pose(3s).translation_m.x, 10.0, 1e-9);
    EXPECT_NEAR(pose(3s).translation_m.y, 5.0, 1e-9);
    EXPECT_LT(glm::distance(model().world_from_model.translation_m, there.translation_m), 1e-12);
}

TEST_F(IncludedActors, StandStillWhereTheyAreToldSo) {
    const auto file = folder_.path() / "models/man/model.sdf";
    const Placement still{"walker", std::nullopt, false};
    const auto model = load_model({.placement = still, .file = file}).scene->models.at(0);
    EXPECT_FALSE(model.movable);
    EXPECT_EQ(model.script, nullptr);
}

TEST_F(SdfActors, AreRefusedWhereNothingMayBeLeftOut) {
    load(world(actor(skin + script(along_x()))), {.strict = true});
    EXPECT_NE(model().script, nullptr);
    const auto file = folder_.write("a.sdf", world(actor(script(along_x()))));
    EXPECT_THAT(faults_of([&] { load_sdf(file, {.strict = true}); }, folder_),
                ElementsAre(HasSubstr("has no <skin>; a capsule")));
}

TEST_F(SdfActors, DoNotCostTheirWorldWithAFaultyPoseOrScale) {
    load(world(
        actor("<pose>here</pose><skin><filename>skin.obj</filename><scale>big</scale></skin>" +
              script(along_x()))));
    EXPECT_THAT(warnings(),
                ElementsAre(":5: actor 'walker' has a <pose> that is not six finite numbers within "
                            "1e7 m; it is left out",
                            ":5: actor 'walker' has a <scale> of 'big'; 1 is taken"));
    EXPECT_NEAR(ahead_m({-2, 0, 0.5}), 1.75, 1e-6);
}

struct Fault {
    std::string inside;
    std::string told;
};

class FaultyActors : public SdfActors, public ::testing::WithParamInterface<Fault> {};

TEST_P(FaultyActors, AreReadAsFarAsTheyCanBe) {
    load(world(actor(skin + script("\n" + GetParam().inside))));
    EXPECT_THAT(warnings(), ElementsAre(GetParam().told));
    EXPECT_TRUE(model().movable);
    EXPECT_NEAR(ahead_m({-9, 0, 0.5}), 8.75, 1e-6) << "it stands at its beginning";
}

const std::string no_time =
    ": actor 'walker' has a waypoint whose <time> is not from 0 to 1e9 s; left out";
const std::string no_pose =
    ": actor 'walker' has a waypoint whose <pose> is not six finite numbers within 1e7 m; left out";
const std::string good = waypoint("0", "0 0 0 0 0 0") + waypoint("5", "5 0 0 0 0 0");

INSTANTIATE_TEST_SUITE_P(
    All, FaultyActors,
    testing::Values(
        Fault{trajectory(good + waypoint("nan", "9 0 0 0 0 0") + waypoint("inf", "9 0 0 0 0 0")),
              ":9" + no_time},
        Fault{trajectory(good + waypoint("-1", "9 0 0 0 0 0")), ":9" + no_time},
        Fault{trajectory(good + waypoint("1e10", "9 0 0 0 0 0")), ":9" + no_time},
        Fault{trajectory(good + waypoint("soon", "9 0 0 0 0 0")), ":9" + no_time},
        Fault{trajectory(good + waypoint("6", "9 0 0 0 0 nan")), ":9" + no_pose},
        Fault{trajectory(good + waypoint("6", "9 0 0")), ":9" + no_pose},
        Fault{trajectory(good + waypoint("6", "1e8 0 0 0 0 0")), ":9" + no_pose},
        Fault{trajectory(good + waypoint("5.0001", "9 0 0 0 0 0")),
              ":6: actor 'walker' has waypoints less than a millisecond apart; the last of them is "
              "taken"},
        Fault{trajectory(""), ":6: actor 'walker' has a <trajectory> without waypoints; left out"},
        Fault{trajectory(good, "tension='2'"),
              ":6: actor 'walker' has a tension of '2', which is not from 0 to 1; 1 is taken"},
        Fault{"<delay_start>-3</delay_start>" + trajectory(good),
              ":6: actor 'walker' has a <delay_start> of '-3', which is not from 0 to 1e9 s; it "
              "does not wait"}),
    [](const auto& fault) { return "fault_" + std::to_string(fault.index); });

TEST_F(SdfActors, HaveALimitToTheirWaypoints) {
    std::string many;
    for (int i = 0; i <= 10'000; ++i)
        many += waypoint(std::to_string(i), std::to_string(i % 7) + " 0 0 0 0 0");
    load(world(actor(skin + script(trajectory(many)))));
    EXPECT_THAT(warnings(),
                ElementsAre(HasSubstr("has more than 10000 waypoints; the rest is left out")));
    EXPECT_NEAR(pose(9999s - 1ns).translation_m.x, 9999 % 7, 1e-6);
    EXPECT_LT(model().script->steps.size(), 200'000U);
}

}  // namespace
}  // namespace scipd::sim
