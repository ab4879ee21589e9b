// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/world/scene_editor.h"

#include <cstdlib>
#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/clock/stepped_clock.h"
#include "tests/daemon/wall_world.h"
#include "tests/support/sanitized.h"
#include "tests/support/temp_dir.h"

namespace scipd::daemon {
namespace {

/// A request that whoever lets go of it last is held up by, until the gate opens.
RequestedBackend request_behind(const std::shared_future<void>& gate) {
    RequestedBackend request;
    request.sensor = "robot/scanner";
    request.backend = "reference";  // which looks at nothing that is settled, nor keeps it
    request.settled = {new BackendChoice, [gate](const BackendChoice* choice) {
                           gate.wait();
                           delete choice;
                       }};
    return request;
}

// They are connections, which must not end on another thread than they live on.
TEST(SceneEditor, LeavesNothingOfThoseWhoAreAnsweredToTheLoader) {
    for (const std::string model : {"model 1", "no such model"}) {
        boost::asio::io_context io;
        World world = wall_world();
        SteppedClock clock;
        std::promise<void> opens;
        const std::shared_future<void> gate = opens.get_future().share();
        Worker worker(io.get_executor());
        SceneEditor editor(world, worker, clock, [&] { return std::vector{request_behind(gate)}; });

        auto somebody = std::make_shared<int>();
        const std::weak_ptr<int> still_there = somebody;
        bool answered = false;
        editor.edit(RemoveModel{model}, [&answered, asks = std::move(somebody)](
                                            const EditOutcome&) { answered = true; });
        EXPECT_TRUE(run_until(io, [&] { return answered; }));
        EXPECT_TRUE(still_there.expired()) << model;
        opens.set_value();
    }
}

TEST(SceneEditor, ForgetsWhatIsWithdrawnBeforeItHasBegun) {
    boost::asio::io_context io;
    World world = wall_world();
    SteppedClock clock;
    Worker worker(io.get_executor());
    SceneEditor editor(world, worker, clock, [] { return std::vector<RequestedBackend>{}; });
    std::string answered;
    const auto says = [&](const std::string& word) {
        return [&answered, word](const EditOutcome&) { answered += word; };
    };
    std::stop_source first_goes;
    std::stop_source second_goes;
    auto somebody = std::make_shared<int>();
    const std::weak_ptr<int> still_there = somebody;
    editor.edit(RemoveModel{"nobody"}, says("first "), first_goes.get_token());
    editor.edit(
        RemoveModel{"model 1"},
        [&answered, asks = std::move(somebody)](const EditOutcome&) { answered += "second "; },
        second_goes.get_token());
    first_goes.request_stop();  // it has begun
    second_goes.request_stop();
    editor.edit(RemoveModel{"nobody"}, says("third"));
    EXPECT_TRUE(still_there.expired()) << "a connection, which would stay open";
    EXPECT_TRUE(run_until(io, [&] { return answered.ends_with("third"); }));
    EXPECT_EQ(answered, "first third");
    EXPECT_NE(world.model("model 1"), nullptr);
}

// Somebody who has hung up shall not keep others waiting.
TEST(SceneEditor, ReadsNoFileToItsEndWhenNobodyWaits) {
    const tests::TempDir folder;
    const auto sleeper = folder.write(
        "sleeper", "#!/bin/sh\n: >" + (folder.path() / "runs").string() + "\nexec sleep 600\n");
    std::filesystem::permissions(sleeper, std::filesystem::perms::owner_all);
    const auto scene = folder.write("world.sdf", "<sdf version='1.9'><world name='w'/></sdf>");
    ASSERT_EQ(setenv("SCIPD_READ", sleeper.c_str(), 1), 0);
    boost::asio::io_context io;
    World world = wall_world();
    SteppedClock clock;
    Worker worker(io.get_executor());
    SceneEditor editor(world, worker, clock, [] { return std::vector<RequestedBackend>{}; });
    editor.set_file(scene, {}, {folder.path()});
    std::string answered;
    std::stop_source goes;
    editor.edit(
        LoadWorld{scene},
        [&](const EditOutcome& outcome) { answered += outcome.messages.at(0) + ' '; },
        goes.get_token());
    editor.edit(RemoveModel{"nobody"}, [&](const EditOutcome&) { answered += "next"; });
    // What is withdrawn before it has begun would tell nothing here.
    EXPECT_TRUE(run_until(io, [&] { return std::filesystem::exists(folder.path() / "runs"); }));
    EXPECT_EQ(answered, "");
    goes.request_stop();
    EXPECT_TRUE(run_until(io, [&] { return answered.ends_with("next"); }));
    EXPECT_THAT(answered, testing::HasSubstr("was not read to its end"));
    unsetenv("SCIPD_READ");
}

class AddedWithinLimits : public testing::Test {
  protected:
    EditOutcome edit(const SceneEdit& wanted) {
        std::optional<EditOutcome> outcome;
        editor_.edit(wanted, [&outcome](const EditOutcome& answer) { outcome = answer; });
        EXPECT_TRUE(run_until(io_, [&] { return outcome.has_value(); }));
        return outcome.value_or(EditOutcome{});
    }

    EditOutcome add(const std::string& name, bool replace = false) {
        AddModel model;
        model.placement.name = name;
        model.mesh = "tetrahedron.stl";
        model.replace = replace;
        return edit(model);
    }

    void allow(Limit limit, int value) {
        LimitValues values;
        values[limit] = value;
        limits_->set(values);
        editor_.set_file(folder_.path() / "world.sdf", {}, {folder_.path()});
    }

    tests::TempDir folder_;
    std::filesystem::path mesh_ = folder_.write("tetrahedron.stl",
                                                "solid t\n"
                                                "facet normal 0 0 -1\nouter loop\nvertex 0 0 0\n"
                                                "vertex 0 1 0\nvertex 1 0 0\nendloop\nendfacet\n"
                                                "facet normal 0 -1 0\nouter loop\nvertex 0 0 0\n"
                                                "vertex 1 0 0\nvertex 0 0 1\nendloop\nendfacet\n"
                                                "endsolid t\n");
    SharedLimits limits_ = std::make_shared<Limits>();
    boost::asio::io_context io_;
    World world_ = wall_world();
    SteppedClock clock_;
    Worker worker_{io_.get_executor()};
    SceneEditor editor_{world_, worker_, clock_, [] { return std::vector<RequestedBackend>{}; },
                        limits_};
};

TEST_F(AddedWithinLimits, AreAsManyModelsAsAllowed) {
    using Result = EditOutcome::Result;
    allow(Limit::added_models, 2);
    EXPECT_EQ(add("a").result, Result::done);
    EXPECT_EQ(add("b").result, Result::done);
    const EditOutcome third = add("c");
    EXPECT_EQ(third.result, Result::too_much);
    EXPECT_EQ(third.messages, std::vector<std::string>{"more than 2 models would have been added; "
                                                       "added_models under limits in the "
                                                       "configuration allows more"});
    EXPECT_EQ(limits_->refused(Limit::added_models), 1U);
    EXPECT_EQ(add("b", true).result, Result::done) << "it takes the place of one of them";
    EXPECT_EQ(edit(RemoveModel{"a"}).result, Result::done);
    EXPECT_EQ(add("c").result, Result::done) << "there is room again";
    EXPECT_EQ(add("d").result, Result::too_much);
    EXPECT_EQ(limits_->refused(Limit::added_models), 2U);
}

std::string material_of(const World& world, const std::string& model) {
    const sim::Scene& scene = *world.scene();
    for (const sim::Object& object : scene.objects) {
        if (scene.models[object.model].name == model) return scene.materials[object.material].name;
    }
    return "none";
}

TEST_F(AddedWithinLimits, GetAnotherMaterialWhereTheyAre) {
    using Result = EditOutcome::Result;
    allow(Limit::added_models, 9);
    EXPECT_EQ(add("a").result, Result::done);
    EXPECT_EQ(add("b").result, Result::done);
    ASSERT_TRUE(world_.place_model(
        "a", {.time = std::chrono::seconds(1), .pose = {{7, 0, 0}, {1, 0, 0, 0}}}));
    EXPECT_EQ(edit(SetMaterial{"a", {"gold"}}).result, Result::done);
    EXPECT_EQ(material_of(world_, "a"), "gold");
    EXPECT_NE(material_of(world_, "b"), "gold");
    EXPECT_EQ(world_.model_pose("a", std::chrono::seconds(2))->translation_m.x, 7)
        << "it stays where it was put";
    EXPECT_EQ(edit(SetMaterial{"nobody", {"gold"}}).result, Result::unknown);
}

std::vector<sim::Material> materials_of(const World& world, const std::string& model) {
    const sim::Scene& scene = *world.scene();
    std::vector<sim::Material> materials;
    for (const sim::Object& object : scene.objects) {
        if (scene.models[object.model].name == model)
            materials.push_back(scene.materials[object.material]);
    }
    return materials;
}

std::vector<std::string> names_of(const std::vector<sim::Material>& materials) {
    std::vector<std::string> names;
    for (const sim::Material& material : materials)
        names.push_back(material.name);
    return names;
}

TEST_F(AddedWithinLimits, GetAMaterialForEachOfTheirObjects) {
    using Result = EditOutcome::Result;
    allow(Limit::added_models, 9);
    AddModel pair;
    pair.placement.name = "pair";
    const std::string box = "<geometry><box><size>1 1 1</size></box></geometry></visual>";
    pair.sdf =
        "<sdf version='1.9' xmlns:scipd='urn:scipd:sdf'><model name='m'><link name='l'>"
        "<visual name='a'><scipd:material>oak</scipd:material>" +
        box +
        "<visual name='b'><scipd:material>elm</scipd:material>"
        "<laser_retro>7</laser_retro>" +
        box + "</link></model></sdf>";
    ASSERT_EQ(edit(pair).result, Result::done);
    const auto before = materials_of(world_, "pair");
    ASSERT_THAT(names_of(before), testing::ElementsAre("oak", "elm"));
    EXPECT_EQ(before[1].laser_retro, 7.0);
    EXPECT_EQ(edit(SetMaterial{"pair", {"gold"}}).result, Result::done);
    EXPECT_THAT(names_of(materials_of(world_, "pair")), testing::ElementsAre("gold", "gold"));
    EXPECT_EQ(edit(SetMaterial{"pair", names_of(before)}).result, Result::done);
    EXPECT_EQ(materials_of(world_, "pair"), before);
    const EditOutcome wrong = edit(SetMaterial{"pair", {"a", "b", "c"}});
    EXPECT_EQ(wrong.result, Result::faulty);
    EXPECT_THAT(wrong.messages, testing::ElementsAre("the model \"pair\" has 2 objects, not 3"));
}

TEST_F(AddedWithinLimits, LeaveNoNamesOfMaterialsBehind) {
    allow(Limit::added_models, 9);
    add("a");
    add("b");
    const std::size_t before = world_.scene()->materials.size();
    for (int i = 0; i < 50; ++i)
        edit(SetMaterial{i % 3 == 0 ? "a" : "b", {"material " + std::to_string(i)}});
    EXPECT_EQ(material_of(world_, "a"), "material 48");
    EXPECT_EQ(material_of(world_, "b"), "material 49");
    EXPECT_LE(world_.scene()->materials.size(), before + 2);
}

TEST_F(AddedWithinLimits, MayComeAsBytes) {
    using Result = EditOutcome::Result;
    allow(Limit::added_models, 9);
    const tests::TempDir temporary;
    ::setenv("TMPDIR", temporary.path().c_str(), 1);
    AddModel model;
    model.placement.name = "a";
    model.mesh_format = "obj";
    // v 0 0 0, v 1 0 0, v 0 1 0, f 1 2 3, a line each
    model.mesh_data = "diAwIDAgMAp2IDEgMCAwCnYgMCAxIDAKZiAxIDIgMwo=";
    EXPECT_EQ(edit(model).result, Result::done);
    ASSERT_TRUE(sim::find_model(*world_.scene(), "a"));
    EXPECT_EQ(sim::tessellate(world_.scene()->objects.back().shape).triangles.size(), 1U);
    model.placement.name = "b";
    model.mesh_data = "AAAA";
    EXPECT_EQ(edit(model).result, Result::faulty);
    const auto refusal = edit(model).messages;
    EXPECT_THAT(refusal, testing::ElementsAre(testing::StartsWith("mesh_data: ")));
    EXPECT_TRUE(std::filesystem::is_empty(temporary.path())) << "nothing is left behind";
    ::unsetenv("TMPDIR");
}

TEST_F(AddedWithinLimits, HaveAsManyTrianglesAsAllowed) {
    using Result = EditOutcome::Result;
    allow(Limit::added_triangles, 4);  // each mesh has 2
    EXPECT_EQ(add("a").result, Result::done);
    EXPECT_EQ(add("b").result, Result::done);
    const EditOutcome third = add("c");
    EXPECT_EQ(third.result, Result::too_much);
    EXPECT_THAT(third.messages, testing::ElementsAre(testing::HasSubstr("added_triangles under")));
    EXPECT_EQ(limits_->refused(Limit::added_triangles), 1U);
    EXPECT_EQ(world_.model("c"), nullptr);
    EXPECT_EQ(edit(RemoveModel{"a"}).result, Result::done);
    EXPECT_EQ(add("c").result, Result::done);
}

class AddedFromFiles : public testing::Test {
  protected:
    EditOutcome add(const std::filesystem::path& file, bool strict) {
        AddModel edit;
        edit.file = file;
        return add(edit, strict);
    }

    EditOutcome add(AddModel edit, bool strict) {
        sim::SceneOptions options;
        options.sdf.strict = strict;
        options.sdf.most_memory_bytes = 8 * 20'000'000;  // of which a model may take an eighth
        options.materials = materials_;
        editor_.set_file(folder_.path() / "worlds/world.sdf", options, {folder_.path() / "worlds"});
        edit.placement.name = "added";
        edit.replace = true;
        return edit_now(edit);
    }

    EditOutcome edit_now(const SceneEdit& edit) {
        std::optional<EditOutcome> outcome;
        editor_.edit(edit, [&outcome](const EditOutcome& answer) { outcome = answer; });
        EXPECT_TRUE(run_until(io_, [&] { return outcome.has_value(); }));
        return outcome.value_or(EditOutcome{});
    }

    tests::TempDir folder_;
    sim::SharedMaterials materials_;
    boost::asio::io_context io_;
    World world_ = wall_world();
    SteppedClock clock_;
    Worker worker_{io_.get_executor()};
    SceneEditor editor_{world_, worker_, clock_, [] { return std::vector<RequestedBackend>{}; }};
};

TEST_F(AddedFromFiles, ObeyStrictOfAnyKind) {
    folder_.write("worlds/a.world", "model ( size [1 1 1] pose [1 0 90] )\n");
    EXPECT_EQ(add("a.world", true).result, EditOutcome::Result::faulty);
    const EditOutcome lenient = add("a.world", false);
    EXPECT_EQ(lenient.result, EditOutcome::Result::done);
    const auto warned =
        testing::ElementsAre(testing::HasSubstr("a.world:1: pose has three numbers"));
    EXPECT_THAT(lenient.messages, warned);
    EXPECT_THAT(add("a.world", true).messages, warned);
}

TEST_F(AddedFromFiles, LieInFoldersThatAreAllowed) {
    const std::string box = "model ( size [1 1 1] pose [1 0 0 90] )\n";
    folder_.write("worlds/a.world", box);
    folder_.write("b.world", box);
    const std::filesystem::path within = folder_.path() / "worlds";
    std::filesystem::create_symlink("../b.world", within / "link.world");
    for (const std::filesystem::path& file : {std::filesystem::path("a.world"), within / "a.world"})
        EXPECT_EQ(add(file, false).result, EditOutcome::Result::done) << file;
    const std::filesystem::path outside = folder_.path() / "b.world";
    AddModel mesh;
    mesh.mesh = "../b.world";
    EXPECT_EQ(add(mesh, false).result, EditOutcome::Result::forbidden);
    for (const std::filesystem::path& file :
         {std::filesystem::path("../b.world"), std::filesystem::path("link.world"), outside,
          std::filesystem::path("../no such file"), std::filesystem::path("/etc/passwd")}) {
        const EditOutcome outcome = add(file, false);
        EXPECT_EQ(outcome.result, EditOutcome::Result::forbidden) << file;
        EXPECT_THAT(outcome.messages,
                    testing::ElementsAre(testing::HasSubstr("`allow` in the configuration")));
    }
    std::optional<EditOutcome> loaded;
    editor_.edit(LoadWorld{outside}, [&](const EditOutcome& answer) { loaded = answer; });
    EXPECT_TRUE(run_until(io_, [&] { return loaded.has_value(); }));
    EXPECT_EQ(loaded.value_or(EditOutcome{}).result, EditOutcome::Result::forbidden);
}

TEST_F(AddedFromFiles, TellOfMaterialsThatNobodyKnows) {
    materials_ = std::make_shared<const sim::MaterialLibrary>();
    const std::string sdf =
        "<sdf version='1.9' xmlns:scipd='urn:scipd:sdf'><model name='m'><link name='l'>"
        "<visual name='v'><scipd:material>cheese</scipd:material><geometry><box>"
        "<size>1 1 1</size></box></geometry></visual></link></model></sdf>";
    folder_.write("worlds/a.sdf", sdf);
    folder_.write("worlds/a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl oak\nf 1 2 3\n");
    AddModel of_file;
    of_file.file = "a.sdf";
    AddModel of_text;
    of_text.sdf = sdf;
    AddModel of_mesh;
    of_mesh.mesh = "a.obj";
    of_mesh.material = "cheese";
    for (const AddModel& edit : {of_file, of_text, of_mesh}) {
        // The reader of so small a mesh has less memory than a sanitizer takes.
        if (tests::sanitized && !edit.mesh.empty()) continue;
        const EditOutcome outcome = add(edit, false);
        EXPECT_EQ(outcome.result, EditOutcome::Result::done);
        EXPECT_THAT(
            outcome.messages,
            testing::ElementsAre(testing::HasSubstr("no library knows the material 'cheese'")));
        EXPECT_EQ(add(edit, true).result, EditOutcome::Result::faulty);
    }
}

/// One triangle, so many times.
std::string heap_of(int triangles) {
    std::string text = "v 1 -1 0\nv 1 1 0\nv 1 0 1\n";
    for (int i = 0; i < triangles; ++i)
        text += "f 1 2 3\n";
    return text;
}

TEST_F(AddedFromFiles, AreRefusedWhereTooManyTrianglesLieInOnePlace) {
    if (tests::sanitized) GTEST_SKIP() << tests::sanitizers_want_memory;
    using Result = EditOutcome::Result;
    folder_.write("worlds/heap.obj", heap_of(10'000));
    folder_.write("worlds/half.obj", heap_of(600));
    const std::string half = "<geometry><mesh><uri>half.obj</uri></mesh></geometry></visual>";
    AddModel mesh;
    mesh.mesh = "heap.obj";
    AddModel many_visuals;
    many_visuals.sdf = "<model name='m'><link name='l'><visual name='v'>" + half +
                       "<visual name='w'>" + half + "</link></model>";
    for (const AddModel& edit : {mesh, many_visuals}) {
        const EditOutcome outcome = add(edit, false);
        EXPECT_EQ(outcome.result, Result::faulty);
        EXPECT_THAT(outcome.messages,
                    testing::ElementsAre(testing::AllOf(
                        testing::HasSubstr("near (1 0 0.5) so many triangles lie in one place"),
                        testing::HasSubstr("world_overlap under limits"))));
    }
    EXPECT_EQ(edit_now(LoadWorld{"heap.obj"}).result, Result::faulty);
    EXPECT_NE(world_.model("model 1"), nullptr) << "the world stays";
    // What stands there already counts, too.
    mesh.mesh = "half.obj";
    mesh.placement.movable = false;
    EXPECT_EQ(add(mesh, false).result, Result::done);
    mesh.placement.name = "second";
    EXPECT_EQ(edit_now(mesh).result, Result::faulty);
    mesh.placement.world_from_model = sim::Pose{{0, 9, 0}, {1, 0, 0, 0}};
    EXPECT_EQ(edit_now(mesh).result, Result::done);
}

TEST_F(AddedFromFiles, MayLieInOnePlaceAsOftenAsTheConfigurationSays) {
    folder_.write("worlds/heap.obj", heap_of(5'000));
    AddModel mesh;
    mesh.placement.name = "heap";
    mesh.mesh = "heap.obj";
    sim::SceneOptions options;
    options.most_overlap = 5'000;
    editor_.set_file(folder_.path() / "worlds/world.sdf", options, {folder_.path() / "worlds"});
    EXPECT_EQ(edit_now(mesh).result, EditOutcome::Result::done);
}

}  // namespace
}  // namespace scipd::daemon
