// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// scipctl's scene, truth and completion commands.
#include <string>
#include <variant>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/support/child.h"
#include "tests/support/temp_dir.h"
#include "tests/tools/scipctl/control_stand_in.h"

namespace scipd::tests {
namespace {

using testing::HasSubstr;

class ScipctlScene : public testing::Test {
  protected:
    Outcome scipctl(std::vector<std::string> words, const std::string& input = {}) const {
        words.insert(words.begin(), {SCIPCTL, "--control", daemon_.socket()});
        return run(words, input);
    }
    std::string refused(const std::vector<std::string>& words, int exit_code = 1) const {
        const Outcome outcome = scipctl(words);
        EXPECT_EQ(outcome.exit_code, exit_code) << outcome.out;
        return outcome.err;
    }
    template <class Edit>
    Edit only_edit() const {
        const auto edits = daemon_.edits();
        EXPECT_EQ(edits.size(), 1U);
        return std::get<Edit>(edits.at(0));
    }

    const ControlStandIn daemon_{{"rescue"}};
    const TempDir directory_;
};

TEST_F(ScipctlScene, ListsModels) {
    const Outcome outcome = scipctl({"scene", "list"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out,
              "maze.sdf\n\n"
              "MODEL    MOVABLE  POSE         OBJECTS  MATERIALS\n"
              "model 0  no       0,0,0,0,0,0  1        material 1\n"
              "model 1  yes      1,2,0,0,0,0  1        default\n");
    const auto document = nlohmann::json::parse(scipctl({"scene", "list", "--json"}).out);
    EXPECT_EQ(document["models"][1]["name"], "model 1");
}

TEST_F(ScipctlScene, ListsTheLidarsOfTheWorld) {
    const Outcome outcome = scipctl({"scene", "list", "--sensors"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out,
              "maze.sdf\n\n"
              "SENSOR           TYPE       POSE              RANGE          ANGLES           "
              "SAMPLES    RATE    FITS BEST\n"
              "model 1::l::lds  ray        1.5,2,0.25,0,0,1  0.12 to 3.5 m  0 to 359.8 deg   "
              "360        5.0 Hz  URG-04LX\n"
              "model 0::l::top  gpu_lidar  0,0,0,0,0,0       0.02 to inf m  -135 to 135 deg  "
              "1081 x 16  -       UST-10LX\n");
    const auto document =
        nlohmann::json::parse(scipctl({"scene", "list", "--sensors", "--json"}).out);
    ASSERT_EQ(document.size(), 2U);
    EXPECT_EQ(document[0]["fits"], "URG-04LX");
    EXPECT_EQ(document[1]["range_m"], nlohmann::json::parse("[0.02,null]"));
}

TEST_F(ScipctlScene, LoadsAWorldByItsWholePath) {
    const std::string file = directory_.write("other.sdf", "<sdf/>");
    const Outcome outcome = scipctl({"scene", "load", file});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "warning: the sun is nothing to a scanner\n");
    EXPECT_EQ(only_edit<daemon::LoadWorld>().file, file);
    EXPECT_THAT(refused({"scene", "load", "/no/such.sdf"}, 2), HasSubstr("/no/such.sdf"));
}

TEST_F(ScipctlScene, TellsWarningsToMachinesToo) {
    const std::string file = directory_.write("other.sdf", "<sdf/>");
    const Outcome outcome = scipctl({"scene", "load", file, "--json"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "{\"warnings\":[\"the sun is nothing to a scanner\"]}\n");
    EXPECT_EQ(outcome.err, "");
}

TEST_F(ScipctlScene, AddsFilesFoldersAndMeshes) {
    const std::string file = directory_.write("crate.sdf", "<model name='x'/>");
    EXPECT_EQ(scipctl({"scene", "add", "crate", file, "--pose", "1,2,0"}).exit_code, 0);
    const auto crate = only_edit<daemon::AddModel>();
    EXPECT_EQ(crate.placement.name, "crate");
    EXPECT_EQ(crate.file, file);
    EXPECT_EQ(crate.placement.movable, std::nullopt);
    EXPECT_EQ(crate.placement.world_from_model, sim::pose_from_rpy({1, 2, 0}, {0, 0, 0}));

    const std::string stl = directory_.write("crate.stl", "solid");
    EXPECT_EQ(scipctl({"scene", "add", "model 1", stl, "--scale", "0.001", "--material", "wood",
                       "--replace"})
                  .exit_code,
              0);
    const auto mesh = std::get<daemon::AddModel>(daemon_.edits().back());
    EXPECT_EQ(mesh.file, stl);
    EXPECT_EQ(mesh.scale, 0.001);
    EXPECT_EQ(mesh.material, "wood");
    EXPECT_TRUE(mesh.replace);
    EXPECT_EQ(mesh.placement.world_from_model, std::nullopt);

    EXPECT_EQ(scipctl({"scene", "add", "piped", "-"}, "<model/>").exit_code, 0);
    EXPECT_EQ(std::get<daemon::AddModel>(daemon_.edits().back()).sdf, "<model/>");

    const std::string folder = directory_.path();
    EXPECT_EQ(scipctl({"scene", "add", "shelf", folder, "--static"}).exit_code, 0);
    const auto shelf = std::get<daemon::AddModel>(daemon_.edits().back());
    EXPECT_EQ(shelf.file, folder);
    EXPECT_EQ(shelf.placement.movable, false);
    EXPECT_EQ(scipctl({"scene", "add", "door", file, "--movable"}).exit_code, 0);
    EXPECT_EQ(std::get<daemon::AddModel>(daemon_.edits().back()).placement.movable, true);
    EXPECT_THAT(refused({"scene", "add", "both", file, "--movable", "--static"}, 2),
                HasSubstr("excludes"));
}

TEST_F(ScipctlScene, MovesAndRemoves) {
    EXPECT_EQ(scipctl({"scene", "move", "model 1", "3,4,0"}).exit_code, 0);
    ASSERT_EQ(daemon_.puts().size(), 1U);
    EXPECT_EQ(daemon_.puts()[0].robot, "model 1");
    EXPECT_EQ(daemon_.puts()[0].pose.translation_m, glm::dvec3(3, 4, 0));
    EXPECT_EQ(scipctl({"pose", "stream"}, R"({"model":"model 1","xyz":[5,6,7]})"
                                          "\n")
                  .exit_code,
              0);
    EXPECT_EQ(daemon_.puts()[1].pose.translation_m, glm::dvec3(5, 6, 7));
    EXPECT_EQ(scipctl({"scene", "remove", "model 1"}).exit_code, 0);
    EXPECT_EQ(only_edit<daemon::RemoveModel>().name, "model 1");
}

TEST_F(ScipctlScene, SaysWhatToTypeInstead) {
    EXPECT_EQ(refused({"scene", "move", "model 0", "1,1,0"}),
              "scipctl: there is no movable model \"model 0\"; there are: model 1\n");
    EXPECT_EQ(refused({"scene", "remove", "door"}),
              "scipctl: there is no model \"door\"; there are: model 0, model 1\n");
    const std::string file = directory_.write("m.stl", "solid");
    EXPECT_EQ(refused({"scene", "add", "model 1", file}),
              "scipctl: there is a model \"model 1\": choose another name, or --replace it\n");
    EXPECT_THAT(refused({"scene", "move", "model 1", "1,1"}, 2), HasSubstr("write X,Y,YAW"));
    EXPECT_EQ(refused({"truth", "rescue/rear"}),
              "scipctl: there is no sensor \"rescue/rear\"; there are: rescue/front\n");
    EXPECT_THAT(refused({"truth", "rescue"}, 2), HasSubstr("write ROBOT/SENSOR"));
    EXPECT_THAT(refused({"truth", "rescue/front", "--scan", "9"}), HasSubstr("from 7 to 7"));
    EXPECT_THAT(
        refused({"dance"}, 2),
        HasSubstr("there is no command \"dance\"; there are: status, sensors, top, pose, scene"));
    EXPECT_EQ(refused({"scene", "add", "crate", "box"}, 2),
              "scipctl: FILE: no such file: box (- reads standard input)\n");
    EXPECT_THAT(refused({"scene"}, 2), HasSubstr("name a command; there are: list, load, add"));
}

TEST_F(ScipctlScene, ShowsTheTruth) {
    const Outcome outcome = scipctl({"truth", "rescue/front"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::string echoes = "1.500 m 0.2500 material 1, 4.000 m 0.0100 in the air";
    const auto blanks = [&](std::size_t used) { return std::string(echoes.size() - used, ' '); };
    EXPECT_EQ(outcome.out,
              "scan 7, step 0 at 2.000000 s, stamp 2000 ms, 1 pose(s), accuracy material\n\n"
              "STEP  TRUE m  INCIDENCE rad  MATERIAL    OBJECT    ECHOES" +
                  blanks(6) + "  BIAS m   READ m  CAUSE     SENT mm    INTENSITY\n" +
                  "44    1.5000  0.0000         material 1  object 0  " + echoes +
                  "  +0.0010  1.5010  measured  1501 4003  900 40\n" +
                  "45    -       -              -           -         -" + blanks(1) +
                  "  -        -       nothing   1          0\n");
    const auto document =
        nlohmann::json::parse(scipctl({"truth", "rescue/front", "--scan", "7", "--json"}).out);
    EXPECT_EQ(document["true_m"], nlohmann::json({1.5, nullptr}));
    EXPECT_EQ(document["sent_echoes_mm"], nlohmann::json({{1501, 4003}, {1}}));
    EXPECT_EQ(document["sent_echoes_intensity"], nlohmann::json({{900, 40}, {0}}));
}

TEST_F(ScipctlScene, ShowsTheTruthOfSomeSteps) {
    const Outcome first = scipctl({"truth", "rescue/front", "--to", "44"});
    EXPECT_THAT(first.out, HasSubstr("\n44 "));
    EXPECT_THAT(first.out, Not(HasSubstr("\n45 ")));
    const Outcome second = scipctl({"truth", "rescue/front", "--from", "45", "--to", "45"});
    EXPECT_THAT(second.out, Not(HasSubstr("\n44 ")));
    EXPECT_THAT(second.out, HasSubstr("\n45 "));
    EXPECT_THAT(refused({"truth", "rescue/front", "--from", "-1"}, 2), HasSubstr("--from"));
}

// The words as a shell hands them over, the last one being typed.
TEST_F(ScipctlScene, CompletesInBash) {
    const auto complete = [](const std::string& words, const std::string& cursor) {
        return run({"/usr/bin/env", "bash", "-c",
                    "source <(" SCIPCTL " completion bash); COMP_WORDS=(" + words +
                        "); COMP_CWORD=" + cursor + "; _scipctl; echo \"${COMPREPLY[@]}\""})
            .out;
    };
    EXPECT_EQ(complete("scipctl s", "1"), "status sensors scene scenario sensor\n");
    EXPECT_EQ(complete("scipctl --control x pose st", "4"), "stream\n");
    EXPECT_EQ(complete("scipctl scene ''", "2"),
              "list load add move remove medium map export --help --control\n");
    EXPECT_EQ(complete("scipctl scene add --sc", "3"), "--scale\n");
    EXPECT_EQ(complete("scipctl scene medium f", "3"), "fog\n");
    EXPECT_EQ(complete("scipctl scene medium fog --v", "4"), "--visibility\n");
    EXPECT_EQ(complete("scipctl scene list --s", "3"), "--sensors\n");
    EXPECT_EQ(complete("scipctl completion ''", "2"), "bash zsh fish --help --control\n");
    EXPECT_EQ(complete("scipctl truth x", "2"), "\n");
}

TEST_F(ScipctlScene, CompletesInZsh) {
    const auto complete = [](const std::string& words, const std::string& cursor) {
        return run({"/usr/bin/env", "zsh", "-fc",
                    "compdef() {}; _files() {}; compadd() { print -r -- \"$@\" }; source <(" SCIPCTL
                    " completion zsh); words=(" +
                        words + "); CURRENT=" + cursor + "; _scipctl"})
            .out;
    };
    EXPECT_EQ(complete("scipctl scene ''", "3"),
              "-- list load add move remove medium map export --help --control\n");
    EXPECT_THAT(complete("scipctl ''", "2"), HasSubstr("truth"));
}

}  // namespace
}  // namespace scipd::tests
