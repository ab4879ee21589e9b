// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Worlds as Gazebo Classic saves them: what it says in <state> counts, every range in closed form.
#include <array>
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/backends/registry.h"
#include "sim/loaders/sdf/sdf.h"
#include "tests/sim/loaders/faults_of.h"
#include "tests/sim/loaders/sdf/sdf_text.h"

namespace scipd::sim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double turn = std::numbers::pi / 2;

class SdfState : public ::testing::Test {
  protected:
    void load(const std::string& models, const std::string& state) {
        const auto text =
            world(models + "\n<state world_name='w'><sim_time>3 0</sim_time>" + state + "</state>");
        auto loaded = load_sdf(folder_.write("a.sdf", text), {});
        scene_ = std::move(loaded.scene);
        warnings_ = std::move(loaded.warnings);
    }

    /// Both agree.
    float range_m(const glm::dvec3& from, const glm::dvec3& along) {
        const glm::vec3 direction{along};
        const Pose pose{from, {1.0, 0.0, 0.0, 0.0}};
        std::array<Hit, 2> hits;
        for (std::size_t i = 0; i < hits.size(); ++i) {
            const auto backend = make_backend(i == 0 ? "reference" : "embree", scene_);
            backend->cast({.directions = {&direction, 1}, .world_from_sensor = {&pose, 1}},
                          {&hits[i], 1});
        }
        EXPECT_EQ(hits[0].met(), hits[1].met());
        if (hits[0].met()) {
            EXPECT_NEAR(hits[0].range_m, hits[1].range_m, 1e-4);
        }
        return hits[0].range_m;
    }

    TempDir folder_;
    SharedScene scene_;
    std::vector<std::string> warnings_;
};

std::string box_model(const std::string& name, const std::string& more = {}) {
    return "<model name='" + name + "'>" + more + "<link name='l'>" + visual("v", unit_box) +
           "</link></model>";
}

std::string saved(const std::string& kind, const std::string& name, const std::string& pose,
                  const std::string& more = {}) {
    return "<" + kind + " name='" + name + "'><pose frame=''>" + pose + "</pose>" + more + "</" +
           kind + ">";
}

TEST_F(SdfState, ModelsLieWhereTheyWereSaved) {
    load(box_model("a", "<pose>2 0 0 0 0 0</pose>") +
             box_model("b", "<static>true</static><pose>0 2 0 0 0 0</pose>"),
         saved("model", "a", "5 0 0 0 0 0") + saved("model", "b", "0 8 0 0 0 0.785398163397448"));
    EXPECT_NEAR(range_m({0, 0, 0}, {1, 0, 0}), 4.5, 1e-5);
    EXPECT_NEAR(range_m({0, 0, 0}, {0, 1, 0}), 8 - std::sqrt(0.5), 1e-5);
    EXPECT_THAT(warnings_, IsEmpty());
    // A movable one begins there.
    EXPECT_EQ(scene_->models.at(0).world_from_model.translation_m, glm::dvec3(5, 0, 0));
}

// The state says of links, and of models in models, where they lie in the world.
TEST_F(SdfState, LinksAndNestedModelsLieInTheWorld) {
    const std::string arm = "<link name='arm'><pose>0 0 1 0 0 0</pose>" + visual("v", unit_box);
    load("<model name='m'><pose>1 1 1 1 0 0</pose>" + arm +
             "</link><link name='held'><pose>0 2 0 0 0 0</pose>" + visual("v", unit_box) +
             "</link><model name='n'><pose>9 9 9 0 0 0</pose>" + arm + "</link></model></model>",
         saved("model", "m", "10 0 0 0 0 " + std::to_string(turn),
               saved("link", "arm", "6 0 0 0 0 0") +
                   saved("model", "n", "0 5 0 0 0 0", saved("link", "arm", "0 7 0 0 0 0"))));
    EXPECT_NEAR(range_m({0, 0, 0}, {1, 0, 0}), 5.5, 1e-5);
    EXPECT_NEAR(range_m({0, 0, 0}, {0, 1, 0}), 6.5, 1e-5);
    // What the state does not name moves with its model: 2 m along the model's y, which is -x.
    EXPECT_NEAR(range_m({8, -5, 0}, {0, 1, 0}), 4.5, 1e-5);
    EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(SdfState, IncludedModelsAndLinksWithColons) {
    folder_.write("models/crate/model.config",
                  "<model><name>crate</name><sdf version='1.9'>model.sdf</sdf></model>");
    folder_.write("models/crate/model.sdf", sdf(box_model("crate")));
    const std::string include = "<include><uri>model://crate</uri><name>c</name></include>";
    load(include + "<model name='m'><link name='c::l'>" + visual("v", unit_box) +
             "</link></model><model name='o'><link name='base'/>" + include + "</model>",
         saved("model", "c", "3 0 0 0 0 0") +
             saved("model", "m", "0 0 0 0 0 0", saved("link", "c::l", "0 3 0 0 0 0")) +
             saved("model", "o", "0 0 0 0 0 0", saved("link", "c::l", "0 0 3 0 0 0")));
    for (const glm::dvec3 along : {glm::dvec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}})
        EXPECT_NEAR(range_m({0, 0, 0}, along), 2.5, 1e-5);
    EXPECT_THAT(warnings_, IsEmpty());
}

// What is round stays round: the largest of its factors counts.
TEST_F(SdfState, ScalesAreOfTheShapes) {
    folder_.write("quad.obj", "v 0 -1 -1\nv 0 1 -1\nv 0 1 1\nv 0 -1 1\nf 1 2 3\nf 1 3 4\n");
    const auto at = [](const std::string& name, const std::string& pose,
                       const std::string& geometry) {
        return "<model name='" + name + "'><pose>" + pose + "</pose><link name='l'>" +
               visual("v", geometry, "<pose>0 0 0.25 0 0 0</pose>") + "</link></model>";
    };
    load(at("box", "10 0 0 0 0 0", unit_box) +
             at("ball", "0 10 0 0 0 0", "<sphere><radius>0.5</radius></sphere>") +
             at("can", "-10 0 0 0 0 0",
                "<cylinder><radius>0.5</radius><length>1</length></cylinder>") +
             at("quad", "0 -10 0 0 0 " + std::to_string(turn), mesh_of("quad.obj")),
         saved("model", "box", "10 0 0 0 0 0", "<scale>4 1 1</scale>") +
             saved("model", "ball", "0 10 0 0 0 0", "<scale>1 2 6</scale>") +
             saved("model", "can", "-10 0 0 0 0 0", "<scale>2 3 4</scale>") +
             saved("model", "quad", "0 -10 0 0 0 " + std::to_string(turn),
                   "<scale>1 0.5 3</scale>"));
    EXPECT_NEAR(range_m({0, 0, 0.25}, {1, 0, 0}), 8.0, 1e-5);
    EXPECT_NEAR(range_m({0, 0, 0.25}, {0, 1, 0}), 7.0, 1e-5);
    EXPECT_NEAR(range_m({0, 0, 0.25}, {-1, 0, 0}), 8.5, 1e-5);
    EXPECT_NEAR(range_m({-10, 0, 9}, {0, 0, -1}), 6.75, 1e-5);
    EXPECT_NEAR(range_m({0.45, 0, 3.2}, {0, -1, 0}), 10.0, 1e-5);
    EXPECT_FALSE(std::isfinite(range_m({0.55, 0, 3.2}, {0, -1, 0})));
    EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(SdfState, WhatItInsertsIsThereAndWhatItDeletesIsNot) {
    load(box_model("a", "<pose>2 0 0 0 0 0</pose>"),
         "<insertions>" + box_model("b") + "</insertions>" + saved("model", "b", "7 0 0 0 0 0") +
             saved("light", "sun", "0 0 9 0 0 0") + "<deletions><name>a</name></deletions>");
    EXPECT_NEAR(range_m({0, 0, 0}, {1, 0, 0}), 6.5, 1e-5);
    EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(SdfState, WhatIsNotThereIsToldOnce) {
    load(box_model("a"), saved("model", "a", "5 0 0 0 0 0", saved("link", "k", "0 0 0 0 0 0")) +
                             "\n" + saved("model", "gone", "1 0 0 0 0 0"));
    EXPECT_NEAR(range_m({0, 0, 0}, {1, 0, 0}), 4.5, 1e-5);
    EXPECT_THAT(warnings_, ElementsAre(HasSubstr("a.sdf:6: <state> tells where 'a::k' and 1 more "
                                                 "lie, and the world has nothing of that name")));
}

TEST_F(SdfState, PosesThatAreNoneAreTold) {
    load(box_model("a", "<pose>2 0 0 0 0 0</pose>"), saved("model", "a", "5 0 0 north"));
    EXPECT_NEAR(range_m({0, 0, 0}, {1, 0, 0}), 1.5, 1e-5);
    EXPECT_THAT(warnings_, ElementsAre(HasSubstr("a.sdf:6: the <state> of a has a pose that is not "
                                                 "a row of finite numbers")));
}

}  // namespace
}  // namespace scipd::sim
