// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What is read for somebody who names a world or a model from outside: nothing that lies elsewhere,
// whatever a file names in turn, and nothing that never ends.
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <boost/asio/io_context.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "daemon/clock/stepped_clock.h"
#include "daemon/world/scene_editor.h"
#include "tests/daemon/wall_world.h"
#include "tests/support/temp_dir.h"

namespace scipd::daemon {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using Result = EditOutcome::Result;

constexpr auto mesh =
    "solid t\nfacet normal 0 0 -1\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\nendloop\n"
    "endfacet\nendsolid t\n";
constexpr auto picture = "P2 2 2 255 0 255 255 0\n";
constexpr auto not_allowed = "lies in no folder that `allow` in the configuration names";

std::string model_with(const std::string& geometry) {
    return "<model name='m'><link name='l'><visual name='v'><geometry>" + geometry +
           "</geometry></visual></link></model>";
}

std::string mesh_model(const std::string& uri) {
    return model_with("<mesh><uri>" + uri + "</uri></mesh>");
}

/// allowed/ is allowed, secret/ beside it is not.
class ReadingForOthers : public testing::Test {
  protected:
    ReadingForOthers() {
        for (const char* folder : {"allowed/", "secret/"}) {
            dir_.write(folder + std::string("part.stl"), mesh);
            dir_.write(folder + std::string("map.pgm"), picture);
        }
        fs::create_symlink("../secret", allowed_ / "way_out");
        fs::create_symlink("../secret/part.stl", allowed_ / "link.stl");
        fs::create_symlink("/dev/zero", allowed_ / "zero.stl");
        ::mkfifo((allowed_ / "fifo.stl").c_str(), S_IRWXU);
        options_.limits.wall_time = std::chrono::seconds(60);
    }

    /// All that is told.
    std::string edit(const SceneEdit& wanted) {
        editor_.set_file(allowed_ / "world.sdf", options_, {allowed_});
        std::optional<EditOutcome> outcome;
        editor_.edit(wanted, [&outcome](const EditOutcome& answer) { outcome = answer; });
        EXPECT_TRUE(run_until(io_, [&] { return outcome.has_value(); }));
        if (!outcome) return "no answer";
        std::string text = outcome->result == Result::done ? "done\n" : "refused\n";
        for (const std::string& message : outcome->messages)
            text += message + "\n";
        return text;
    }

    std::string add(AddModel model) {
        model.placement.name = "added";
        model.replace = true;
        return edit(model);
    }

    std::string add_text(const std::string& sdf) { return add({.sdf = sdf}); }

    tests::TempDir dir_;
    const fs::path allowed_ = dir_.path() / "allowed";
    const fs::path secret_ = dir_.path() / "secret";
    sim::SceneOptions options_;
    boost::asio::io_context io_;
    World world_ = wall_world();
    SteppedClock clock_;
    Worker worker_{io_.get_executor()};
    SceneEditor editor_{world_, worker_, clock_, [] { return std::vector<RequestedBackend>{}; }};
};

TEST_F(ReadingForOthers, TakesMeshesOfAllowedFoldersAlone) {
    for (const std::string& uri : {std::string("part.stl"), (allowed_ / "part.stl").string(),
                                   std::string("../allowed/part.stl")})
        EXPECT_EQ(add_text(mesh_model(uri)), "done\n") << uri;
    for (const std::string& uri :
         {(secret_ / "part.stl").string(), std::string("../secret/part.stl"),
          std::string("link.stl"), std::string("way_out/part.stl"),
          "file://" + (secret_ / "part.stl").string(), std::string("/dev/zero")}) {
        EXPECT_THAT(add_text(mesh_model(uri)), HasSubstr(not_allowed)) << uri;
    }
}

// Neither whether something is there, nor how it is called.
TEST_F(ReadingForOthers, TellsNothingOfWhatLiesElsewhere) {
    const auto refusal = [this](const fs::path& folder, const std::string& name) {
        std::string text = add_text(mesh_model(folder / name));
        for (auto at = text.find(name); at != text.npos; at = text.find(name))
            text.erase(at, name.size());
        return text;
    };
    for (const fs::path& folder : {secret_, fs::path("../secret"), fs::path("way_out")}) {
        const std::string nothing = refusal(folder, "none.stl");
        EXPECT_THAT(nothing, HasSubstr(not_allowed));
        for (const char* name : {"part.stl", "PART.stl", "part.stl/x.stl"})
            EXPECT_EQ(refusal(folder, name), nothing) << folder << name;
    }
    for (const char* way : {"../secret/..", "../SECRET/..", "../none/.."})
        EXPECT_EQ(add_text(mesh_model(way + std::string("/allowed/part.stl"))), "done\n") << way;
}

TEST_F(ReadingForOthers, OpensNoFifosAndNoDevices) {
    EXPECT_THAT(add_text(mesh_model("fifo.stl")), HasSubstr("is a FIFO"));
    EXPECT_THAT(add_text(mesh_model("zero.stl")), HasSubstr(not_allowed));
    ::mkfifo((allowed_ / "world.sdf").c_str(), S_IRWXU);
    EXPECT_THAT(edit(LoadWorld{"world.sdf"}), HasSubstr("is a FIFO"));
    EXPECT_THAT(add({.mesh = "fifo.stl"}), HasSubstr("is a FIFO"));
}

TEST_F(ReadingForOthers, TakesIncludedModelsOfAllowedFoldersAlone) {
    for (const char* folder : {"allowed/box/", "secret/box/"}) {
        dir_.write(folder + std::string("model.config"),
                   "<model><name>box</name><sdf version='1.6'>model.sdf</sdf></model>");
        dir_.write(folder + std::string("model.sdf"),
                   "<sdf version='1.6'>" + model_with("<box><size>1 1 1</size></box>") + "</sdf>");
    }
    const auto including = [](const std::string& uri) {
        return "<model name='m'><include><uri>" + uri + "</uri></include></model>";
    };
    EXPECT_EQ(add_text(including((allowed_ / "box").string())), "done\n");
    EXPECT_THAT(add_text(including((secret_ / "box").string())), HasSubstr(not_allowed));
    EXPECT_THAT(add_text(including("way_out/box")), HasSubstr(not_allowed));
    // Whoever starts scipd names where models are.
    ::setenv("GZ_SIM_RESOURCE_PATH", secret_.c_str(), 1);
    EXPECT_EQ(add_text(including("model://box")), "done\n");
    ::unsetenv("GZ_SIM_RESOURCE_PATH");
}

TEST_F(ReadingForOthers, TakesPicturesOfAllowedFoldersAlone) {
    const auto map = [&](const std::string& image) {
        dir_.write("allowed/map.yaml", "image: " + image +
                                           "\nresolution: 1\norigin: [0, 0, 0]\nnegate: 0\n"
                                           "occupied_thresh: 0.65\nfree_thresh: 0.2\n");
        return edit(LoadWorld{"map.yaml"});
    };
    EXPECT_THAT(map("map.pgm"), testing::StartsWith("done\n"));
    EXPECT_THAT(map("../secret/map.pgm"), HasSubstr(not_allowed));
    const auto ground = [&](const fs::path& image) {
        return add_text(model_with("<heightmap><uri>" + image.string() +
                                   "</uri><size>2 2 1</size></heightmap>"));
    };
    EXPECT_THAT(ground(secret_ / "map.pgm"), HasSubstr(not_allowed));
    EXPECT_THAT(ground(allowed_ / "map.pgm"), testing::Not(HasSubstr(not_allowed)));
}

TEST_F(ReadingForOthers, TakesIncludesOfStageOfAllowedFoldersAlone) {
    for (const char* folder : {"allowed/", "secret/"})
        dir_.write(folder + std::string("kinds.inc"), "define crate model ( size [1 1 1] )\n");
    const auto world = [&](const std::string& file) {
        dir_.write("allowed/a.world", "include \"" + file + "\"\ncrate ( pose [1 0 0 0] )\n");
        return edit(LoadWorld{"a.world"});
    };
    EXPECT_THAT(world("kinds.inc"), testing::StartsWith("done\n"));
    EXPECT_THAT(world("../secret/kinds.inc"), testing::StartsWith("refused\n"));
}

/// With a script in the place of xacro.
class XacroForOthers : public ReadingForOthers {
  protected:
    XacroForOthers() { ::setenv("PATH", ((dir_.path() / "bin:") += before_).c_str(), 1); }
    ~XacroForOthers() override { ::setenv("PATH", before_.c_str(), 1); }

    std::string add_by(const std::string& script) {
        const auto program = dir_.write("bin/xacro", "#!/bin/sh\n" + script);
        fs::permissions(program, fs::perms::owner_all);
        dir_.write("allowed/robot.urdf.xacro", "<robot name='r'/>");
        return add({.file = "robot.urdf.xacro"});
    }

    const std::string before_ = std::getenv("PATH");
};

constexpr auto urdf =
    "<robot name='r'><link name='l'><visual><geometry><box size='1 2 3'/></geometry></visual>"
    "</link></robot>";

// The program opens files itself: the kernel holds it to the folders.
TEST_F(XacroForOthers, IncludesFilesOfAllowedFoldersAlone) {
    dir_.write("allowed/part.xml", urdf);
    dir_.write("secret/part.xml", urdf);
    const std::string inside = add_by("cat '" + (allowed_ / "part.xml").string() + "'\n");
    if (inside.find("has no Landlock") != inside.npos)
        GTEST_SKIP() << "and so xacro is refused: " << inside;
    EXPECT_EQ(inside, "done\n");
    for (const fs::path& file : {secret_ / "part.xml", allowed_ / "way_out/part.xml"}) {
        EXPECT_THAT(add_by("cat '" + file.string() + "'\n"),
                    testing::AllOf(testing::StartsWith("refused\n"), HasSubstr("ermission denied")))
            << file;
    }
    add_by("echo changed > '" + (allowed_ / "new").string() + "'\necho \"" + urdf + "\"\n");
    EXPECT_FALSE(fs::exists(allowed_ / "new"));
}

TEST_F(XacroForOthers, EndsWithTheTimeThatAWorldMayTake) {
    options_.limits.wall_time = std::chrono::seconds(1);
    EXPECT_THAT(add_by("while :; do sleep 1; done\n"),
                testing::AllOf(testing::StartsWith("refused\n"), HasSubstr("within 1 s"),
                               HasSubstr("world_load_s under limits")));
}

}  // namespace
}  // namespace scipd::daemon
