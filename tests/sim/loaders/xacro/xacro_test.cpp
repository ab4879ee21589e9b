// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Robots in xacro, with a script in the place of the program.
#include <cstdlib>
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/loaders/file/confined.h"
#include "sim/loaders/scene_file.h"
#include "tests/sim/loaders/faults_of.h"

namespace scipd::sim {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// With a PATH of its own until the end.
class Xacro : public ::testing::Test {
  protected:
    Xacro() { setenv("PATH", (folder_.path() / "bin").c_str(), 1); }
    ~Xacro() override { setenv("PATH", before_.c_str(), 1); }

    void install(const std::string& script) {
        const auto program = folder_.write("bin/xacro", "#!/bin/sh\n" + script);
        std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    }
    [[nodiscard]] std::filesystem::path robot() const {
        return folder_.write("a b$(touch x)/robot.urdf.xacro", "<robot name='r'/>");
    }
    std::vector<std::string> faults() {
        return faults_of([&] { load_scene(robot()); }, folder_);
    }

    TempDir folder_;
    std::string before_ = std::getenv("PATH");
};

constexpr auto box_robot =
    "<robot name='r'><link name='l'><visual><geometry><box size='1 2 3'/></geometry></visual>"
    "</link></robot>";

TEST_F(Xacro, isExpandedByTheProgram) {
    // What it gets is one word, whatever is in it, and nothing to read.
    install(
        "read line && exit 3\n[ $# = 1 ] && [ -f \"$1\" ] || exit 4\n"
        "echo 'a warning' >&2\necho \"" +
        std::string(box_robot) + "\"\n");
    const auto loaded = load_scene(robot());
    ASSERT_EQ(loaded.scene->objects.size(), 1U);
    EXPECT_EQ(std::get<Box>(loaded.scene->objects[0].shape).size_m, glm::dvec3(1, 2, 3));
}

TEST_F(Xacro, itsOwnErrorsAreShown) {
    install(
        "echo '<robot>'\necho \"undefined name 'wheel'\nwhen processing file $1\" >&2\nexit 2\n");
    EXPECT_THAT(faults(), ElementsAre("a b$(touch x)/robot.urdf.xacro: xacro fails: undefined name "
                                      "'wheel'\nwhen processing file a b$(touch "
                                      "x)/robot.urdf.xacro"));
    install("exit 7\n");
    EXPECT_THAT(faults(), ElementsAre(HasSubstr("xacro fails: ends with 7")));
    install("echo '<robot'\n");
    EXPECT_THAT(faults(), ElementsAre(HasSubstr("robot.urdf.xacro (as xacro prints it)")));
}

// The script prints a box whose length is what it was asked for.
TEST_F(Xacro, getsTheArguments) {
    install(
        "[ \"$2\" = length:=4 ] && [ \"$3\" = \"name:=a b\" ] && [ $# = 3 ] || exit 4\n"
        "echo \"<robot name='r'><link name='l'><visual><geometry><box size='${2#length:=} 2 3'/>"
        "</geometry></visual></link></robot>\"\n");
    const auto loaded = load_scene(robot(), {.sdf = {.xacro = {{"name", "a b"}, {"length", "4"}}}});
    ASSERT_EQ(loaded.scene->objects.size(), 1U);
    EXPECT_EQ(std::get<Box>(loaded.scene->objects[0].shape).size_m, glm::dvec3(4, 2, 3));
}

/// The script of a program that expands every file to a box, and lists what it includes as `xacro
/// --deps` does.
std::string script_with(const std::string& included) {
    return "for word; do [ \"$word\" = --deps ] && { echo '" + included +
           "'; exit; }; done\necho \"" + box_robot + "\"\n";
}

TEST_F(Xacro, warnsOfArgumentsThatNoFileHas) {
    const auto file =
        folder_.write("r.xacro",
                      "<robot name='r' xmlns:xacro='x'><!-- <xacro:arg name='old'/> -->"
                      "<xacro:arg default='1' name='length'/><link name='$(arg tool )'/></robot>");
    folder_.write("with a blank.xacro", "<robot xmlns:x='x'><x:arg\nname=\"speed\"/></robot>");
    const auto warnings = [&](const XacroArguments& arguments, bool strict = false) {
        const SceneOptions options{.sdf = {.xacro = arguments, .strict = strict}};
        return without_folder(load_scene(file, options).warnings, folder_);
    };
    const std::string included = (folder_.path() / "with a blank.xacro").string();
    install(script_with(included + " " + included));
    EXPECT_THAT(warnings({{"length", "2"}, {"tool", "a"}, {"speed", "3"}}), ElementsAre());
    EXPECT_THAT(warnings({{"lenght", "2"}, {"old", "a"}, {"tool", "a"}}),
                ElementsAre("r.xacro: has no xacro argument 'lenght'; it has length, speed, tool",
                            "r.xacro: has no xacro argument 'old'; it has length, speed, tool"));
    const auto strictly = [&] { (void)warnings({{"lenght", "2"}}, true); };
    EXPECT_THAT(faults_of(strictly, folder_),
                ElementsAre(HasSubstr("has no xacro argument 'lenght'")));
    // The arguments of a file that cannot be read are unknown.
    install(script_with(included + " /none.xacro"));
    EXPECT_THAT(warnings({{"lenght", "2"}}), ElementsAre());
    install("[ $# = 2 ] || exit 2\necho \"" + std::string(box_robot) + "\"\n");
    EXPECT_THAT(warnings({{"lenght", "2"}}), ElementsAre());
}

TEST_F(Xacro, sentencesForMissingArgumentsAndForMacrosAlone) {
    install("echo 'error: Undefined substitution argument lidar' >&2\nexit 2\n");
    EXPECT_THAT(faults(), ElementsAre(AllOf(HasSubstr("substitution argument lidar; --xacro "
                                                      "NAME:=VALUE"),
                                            HasSubstr("xacro: {NAME: VALUE}"))));
    install("echo \"<robot name='r'/>\"\n");
    EXPECT_THAT(faults(), ElementsAre(AllOf(HasSubstr("has no link once xacro has expanded it"),
                                            HasSubstr("name the file that calls them"))));
}

TEST_F(Xacro, withoutTheProgramIsToldHowToConvert) {
    EXPECT_THAT(faults(), ElementsAre(AllOf(HasSubstr("which is not installed here"),
                                            HasSubstr("pip install xacro"),
                                            HasSubstr("`xacro robot.urdf.xacro > robot.urdf`"))));
    const auto bare = folder_.write("r.xacro", "<robot name='r'/>");
    EXPECT_THAT(faults_of([&] { load_scene(bare); }, folder_),
                ElementsAre(HasSubstr("`xacro r.xacro > r.urdf`")));
}

TEST_F(Xacro, aProgramThatDoesNotEndIsEnded) {
    install("while :; do :; done\n");
    const Confines brief{.processor_time = std::chrono::seconds(60),
                         .memory_bytes = std::size_t{1} << 30U,
                         .wall_time = std::chrono::milliseconds(300)};
    EXPECT_THROW(output_of(brief, {"xacro"}), std::runtime_error);
}

TEST_F(Xacro, noFileIsNone) {
    EXPECT_THAT(faults_of([&] { load_scene(folder_.path() / "none.xacro"); }, folder_),
                ElementsAre("none.xacro: no such file; name a robot written in xacro"));
}

// A world may come from anywhere; the program would do whatever it says.
TEST_F(Xacro, isNothingThatAWorldMayInclude) {
    install(": > " + (folder_.path() / "ran").string() + "\n");
    folder_.write("robot.urdf.xacro", box_robot);
    const auto world = folder_.write(
        "a.sdf",
        "<sdf version='1.9'><world name='w'><include><uri>robot.urdf.xacro</uri></include>"
        "<model name='m'><link name='l'><visual name='v'><geometry><box><size>1 1 1</size></box>"
        "</geometry></visual></link></model></world></sdf>");
    try {
        load_scene(world);
    } catch (const LoadError&) {
    }
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "ran"));
}

}  // namespace
}  // namespace scipd::sim
