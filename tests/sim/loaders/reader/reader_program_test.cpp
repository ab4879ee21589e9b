// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The program that reads worlds, and scripts in its place that do what a broken one might.
#include "sim/loaders/reader/reader_program.h"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include "sim/loaders/file/load_error.h"
#include "tests/support/temp_dir.h"

namespace scipd::sim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
namespace fs = std::filesystem;

constexpr auto box_world =
    "<sdf version='1.9'><world name='w'><model name='m'><link name='l'><visual name='v'>"
    "<geometry><box><size>1 1 1</size></box></geometry></visual></link></model></world></sdf>";

class ReaderProgram : public ::testing::Test {
  protected:
    /// A program that does this in place of scipd-read.
    fs::path program(const std::string& script) {
        const auto file = folder_.write("scipd-read", "#!/bin/sh\n" + script);
        fs::permissions(file, fs::perms::owner_all);
        return file;
    }

    static std::vector<std::string> faults_of(const fs::path& program, const fs::path& world = "x",
                                              const LoadLimits& limits = {}) {
        try {
            (void)read_by(program, {.wanted = world}, limits);
        } catch (const LoadError& error) {
            return error.faults();
        }
        return {};
    }

    tests::TempDir folder_;
};

/// The most memory that a child of this process has taken.
double most_of_children_bytes() {
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

std::string thousands_of(const std::string& element) {
    std::string text = "<sdf version='1.9'><model name='m'>";
    for (int i = 0; i < 50'000; ++i)
        text += element;
    return text + "</model></sdf>";
}

TEST_F(ReaderProgram, TakesLittleMemoryForManyParts) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "sanitizers take memory of their own";
#endif
    const auto read = [&](const std::string& text) {
        try {
            (void)read_by(reader_program(),
                          {.wanted = folder_.write("w.sdf", text), .most_overlap = 50'000}, {});
        } catch (const LoadError&) {
            // Nothing in it can be seen, which is found out at the end.
        }
        return most_of_children_bytes();
    };
    const double alone_bytes = read(box_world);
    for (const char* element : {"<link/>", "<joint/>", "<frame/>", "<actor/>",
                                "<link name='a123'/>", "<link><visual/></link>"}) {
        const std::string text = thousands_of(element);
        EXPECT_LT(read(text) - alone_bytes, 40.0 * static_cast<double>(text.size())) << element;
    }
}

TEST_F(ReaderProgram, IsThereAndReads) {
    const auto world = folder_.write("w.sdf", box_world);
    const auto [scene, warnings] =
        read_by(reader_program(), {.wanted = world, .most_overlap = 1000}, {});
    EXPECT_THAT(warnings, IsEmpty());
    ASSERT_EQ(scene->objects.size(), 1U);
    EXPECT_EQ(scene->objects[0].name, "m::l::v");
}

TEST_F(ReaderProgram, FaultsArriveEach) {
    const auto faults = faults_of(reader_program(), folder_.write("w.sdf", "<sdf><world"));
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_THAT(faults[0], HasSubstr("w.sdf:1"));
}

TEST_F(ReaderProgram, ThatCannotBeStartedIsAFault) {
    EXPECT_THAT(faults_of(folder_.path() / "none"),
                ElementsAre(HasSubstr("none cannot be started: No such file")));
}

// The whole of a world may take so long, and the file that took it is one of many.
TEST_F(ReaderProgram, ThatTakesTooLongTellsWhatItWasAtAndTheLimit) {
    const LoadLimits brief{.wall_time = std::chrono::seconds{1}};
    EXPECT_THAT(faults_of(program("printf 'reading a.dae' >&3\nexec sleep 9\n"), "x", brief),
                ElementsAre("x: was not read within 1 s; at last it was reading a.dae; "
                            "world_load_s under limits in the configuration allows more"));
    EXPECT_THAT(
        faults_of(program("head -c 100000 /dev/zero | tr '\\0' a >&3\nexec sleep 9\n"), "x", brief),
        ElementsAre(HasSubstr("it was aaa")));
}

TEST_F(ReaderProgram, ThatNobodyWaitsForEndsAtOnce) {
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THAT(faults_of(program("exec sleep 9\n"), "x", {.stop = stop.get_token()}),
                ElementsAre("x: was not read to its end"));
}

TEST_F(ReaderProgram, ThatCrashesIsAFault) {
    EXPECT_THAT(faults_of(program("kill -ABRT $$\n")),
                ElementsAre("x: crashes the library that reads it (signal 6)"));
    EXPECT_THAT(faults_of(program("exit 3\n")),
                ElementsAre("x: crashes the library that reads it"));
    EXPECT_THAT(faults_of(program("printf why; exit 1\n")), ElementsAre("x: why"));
}

TEST_F(ReaderProgram, ThatTalksNonsenseIsAFault) {
    for (const char* nonsense :
         {"exit 0\n", "head -c 9 /dev/zero\n", "head -c 4 /dev/zero\n", "yes | head -c 100000\n"}) {
        EXPECT_THAT(faults_of(program(nonsense)),
                    ElementsAre(HasSubstr("x: was read, but its data did not arrive")))
            << nonsense;
    }
}

// Whoever leads it astray finds no connection and no secret.
TEST_F(ReaderProgram, HasTheseDescriptorsAlone) {
    constexpr int here = 50;
    ASSERT_EQ(fcntl(STDOUT_FILENO, F_DUPFD, here), here);
    // A shell has descriptors of its own, below.
    EXPECT_THAT(faults_of(program("[ -e /proc/$$/fd/3 ] && [ ! -e /proc/$$/fd/50 ] && printf so\n"
                                  "exit 1\n")),
                ElementsAre("x: so"));
    close(here);
}

TEST_F(ReaderProgram, SeesOfTheEnvironmentWhatItNeeds) {
    setenv("SCIPD_TEST_SECRET", "s3cret", 1);
    setenv("SDF_PATH", "/models", 1);
    const auto said = [&](const fs::path& world, const LoadLimits& limits) {
        return faults_of(program("echo \"$SDF_PATH:$SCIPD_TEST_SECRET\"; exit 1\n"), world, limits);
    };
    EXPECT_THAT(said("a.sdf", {}), ElementsAre("a.sdf: /models:\n"));
    // $(env SCIPD_TEST_SECRET) is xacro, but not for those who are held to folders.
    EXPECT_THAT(said("a.xacro", {}), ElementsAre("a.xacro: /models:s3cret\n"));
    EXPECT_THAT(said("a.XACRO", {}), ElementsAre("a.XACRO: /models:s3cret\n"));
    EXPECT_THAT(said("a.xacro", {.folders = Folders{"/"}}), ElementsAre("a.xacro: /models:\n"));
    unsetenv("SDF_PATH");
    unsetenv("SCIPD_TEST_SECRET");
}

}  // namespace
}  // namespace scipd::sim
