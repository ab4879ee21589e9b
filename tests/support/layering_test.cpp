// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Checks that the sources keep the laws in the READMEs of their folders (folder_law.h):
// dependencies go one way, no two files include each other, no two headers have one name, and no
// file is too long.
#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/folder_law.h"
#include "tests/support/source_tree.h"

namespace {

using namespace scipd::testing;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Pairs that still exist. Do not add any, and remove those that are gone.
const std::vector<std::string> known_pairs = {};

const SourceTree& sources() {
    static const SourceTree tree = tree_at(SCIPD_SOURCES);
    return tree;
}

TEST(FolderLaws, StandInEveryReadme) {
    EXPECT_GT(sources().size(), 500U);
    EXPECT_THAT(faults_of_laws(sources()), IsEmpty());
}

TEST(FolderLaws, AreKept) {
    EXPECT_THAT(faults_of_includes(sources()), IsEmpty());
}

TEST(FolderLaws, AreKeptByWayOfOthersToo) {
    EXPECT_THAT(faults_of_reach(sources()), IsEmpty());
}

TEST(FolderLaws, LetNoTwoNeedEachOther) {
    const auto pairs = pairs_in(sources());
    for (const std::string& pair : pairs)
        EXPECT_TRUE(std::ranges::find(known_pairs, pair) != known_pairs.end())
            << pair << " include each other; give what both need a header of its own";
    for (const std::string& known : known_pairs)
        EXPECT_TRUE(std::ranges::find(pairs, known) != pairs.end())
            << known << " is no pair any more; take it off known_pairs";
}

TEST(FolderLaws, LetNoTwoHeadersHaveOneName) {
    EXPECT_THAT(faults_of_names(sources()), IsEmpty());
}

TEST(FolderLaws, KeepFilesShort) {
    EXPECT_THAT(faults_of_length(sources()), IsEmpty());
}

// From here on: tests that these checks find faults at all.

/// A tree whose folders keep their laws.
SourceTree sound() {
    return {{"protocol/README.md",
             "# protocol/\n\n- May include: nothing else.\n"
             "- Never reaches: `thread`.\n"},
            {"protocol/status.h", "#include <vector>\n"},
            {"protocol/status.cpp", "#include \"protocol/status.h\"\n"},
            {"sim/README.md", "A scanner.\n\n- May include: nothing else.\n"},
            {"sim/time.h", "#include <chrono>\n"},
            {"sim/world/README.md",
             "- May include: `sim/*`,\n  `glm/`.\n"
             "- `child.cpp` alone may also include `poll.h`, `sys/`: see `anything/`.\n"},
            {"sim/world/pose.h", "#include <glm/vec3.hpp>\n#include \"sim/time.h\"\n"},
            {"sim/world/child.cpp", "#include <poll.h>\n#include <sys/wait.h>\n"},
            {"daemon/link/README.md",
             "- May include: `daemon/device/`.\n- Never reaches: `sim/world/`.\n"},
            {"daemon/link/port.cpp", "#include \"daemon/device/device.h\"\n"},
            {"daemon/device/README.md", "- May include: `sim/`.\n"},
            {"daemon/device/device.h", "#include \"sim/time.h\"\n"}};
}

/// The sound tree with this file added or replaced.
SourceTree with(const std::string& path, const std::string& text) {
    SourceTree tree = sound();
    tree[path] = text;
    return tree;
}

std::string including(const std::string& file) {
    return "// a comment\n#include \"" + file + "\"\n";
}

TEST(FolderLawsSelfTest, FindNoFaultInWhatIsSound) {
    EXPECT_THAT(faults_of_laws(sound()), IsEmpty());
    EXPECT_THAT(faults_of_includes(sound()), IsEmpty());
    EXPECT_THAT(faults_of_reach(sound()), IsEmpty());
    EXPECT_THAT(faults_of_length(sound()), IsEmpty());
    EXPECT_THAT(faults_of_names(sound()), IsEmpty());
    EXPECT_THAT(pairs_in(sound()), IsEmpty());
}

TEST(FolderLawsSelfTest, NameAnArrowThatGoesBack) {
    EXPECT_THAT(faults_of_includes(with("sim/time.h", including("sim/world/pose.h"))),
                ElementsAre("sim/time.h:2 includes sim/world/pose.h, which sim/README.md does not "
                            "allow"));
    EXPECT_THAT(faults_of_includes(with("protocol/status.h", including("sys/socket.h"))),
                ElementsAre("protocol/status.h:2 includes sys/socket.h, which protocol/README.md "
                            "does not allow"));
}

TEST(FolderLawsSelfTest, NameWhatOnlyAnotherFileMay) {
    EXPECT_THAT(faults_of_includes(with("sim/world/pose.h", including("poll.h"))),
                ElementsAre("sim/world/pose.h:2 includes poll.h, which sim/world/README.md does "
                            "not allow"));
    // The text after the colon is only the reason.
    EXPECT_THAT(faults_of_includes(with("sim/world/child.cpp", including("anything/a.h"))),
                ElementsAre("sim/world/child.cpp:2 includes anything/a.h, which "
                            "sim/world/README.md does not allow"));
}

TEST(FolderLawsSelfTest, NameAFolderBelowThatIsNotSpokenOf) {
    EXPECT_THAT(faults_of_includes(with("sim/world/pose.h", including("sim/backends/fan.h"))),
                ElementsAre("sim/world/pose.h:2 includes sim/backends/fan.h, which "
                            "sim/world/README.md does not allow"));
}

TEST(FolderLawsSelfTest, NameWhatNoLawMayAllow) {
    SourceTree tree = with("protocol/README.md", "- May include: `protocol/`, `tests/`.\n");
    tree["protocol/status.h"] = including("tests/support/child.h");
    tree["protocol/status.cpp"] = including("protocol/client/driver.h");
    EXPECT_THAT(faults_of_includes(tree),
                ElementsAre("protocol/status.cpp:2 includes protocol/client/driver.h: the "
                            "scanner's side does not know the host's",
                            "protocol/status.h:2 includes tests/support/child.h: nothing that is "
                            "shipped leans on the tests"));
}

TEST(FolderLawsSelfTest, NameAFolderWithoutALaw) {
    const auto fault =
        "sim/world/README.md has no line that begins with `- May include:`; say there what this "
        "folder may include";
    EXPECT_THAT(faults_of_laws(with("sim/world/README.md", "# A world\n")), ElementsAre(fault));
    EXPECT_THAT(faults_of_laws(with("sim/world/README.md", "# W\n\n## Law\n\n- May include: x\n")),
                ElementsAre(fault));
    SourceTree tree = sound();
    tree.erase("sim/world/README.md");
    EXPECT_THAT(faults_of_laws(tree), ElementsAre(fault));
}

TEST(FolderLawsSelfTest, NameALawOfWhatIsNotThere) {
    EXPECT_THAT(faults_of_laws(with("daemon/device/README.md",
                                    "- May include: `sim/`, `sim/gone/`, `boost/`.\n"
                                    "- `gone.cpp` alone may also include `poll.h`: it polls.\n")),
                ElementsAre("daemon/device/README.md names sim/gone/, which is not there",
                            "daemon/device/README.md names gone.cpp, which is not there"));
}

TEST(FolderLawsSelfTest, NameWhatIsReachedByWayOfOthers) {
    EXPECT_THAT(faults_of_reach(with("daemon/device/device.h", including("sim/world/pose.h"))),
                ElementsAre("daemon/link/port.cpp -> daemon/device/device.h -> sim/world/pose.h: "
                            "daemon/link/README.md rules that out"));
    EXPECT_THAT(faults_of_reach(with("protocol/status.h", "#include <thread>\n")),
                ElementsAre("protocol/status.cpp -> protocol/status.h -> thread: "
                            "protocol/README.md rules that out",
                            "protocol/status.h -> thread: protocol/README.md rules that out"));
}

TEST(FolderLawsSelfTest, NameTwoThatNeedEachOther) {
    SourceTree tree = with("sim/time.h", including("sim/world/pose.h"));
    EXPECT_THAT(pairs_in(tree), ElementsAre("sim/time <-> sim/world/pose", "sim/ <-> sim/world/"));
    // A header and the other's source.
    tree = with("sim/world/mesh.h", including("sim/world/child.h"));
    tree["sim/world/child.h"] = "";
    tree["sim/world/child.cpp"] = including("sim/world/mesh.h");
    EXPECT_THAT(pairs_in(tree), ElementsAre("sim/world/child <-> sim/world/mesh"));
}

TEST(FolderLawsSelfTest, NameHeadersOfOneNameAndWhatLiesBesideTheRooms) {
    EXPECT_THAT(faults_of_names(with("daemon/link/status.h", "")),
                ElementsAre("protocol/status.h has the name of daemon/link/status.h; call it after "
                            "what only it is about"));
    EXPECT_THAT(faults_of_names(with("daemon/link/status.cpp", "")), IsEmpty());
    EXPECT_THAT(faults_of_names(with("daemon/server.h", "")), IsEmpty());
    EXPECT_THAT(faults_of_names(with("daemon/rig.cpp", "")),
                ElementsAre("daemon/rig.cpp lies right in daemon/, which only puts its folders "
                            "together"));
}

TEST(FolderLawsSelfTest, CountLines) {
    EXPECT_THAT(faults_of_length(with("sim/a.h", std::string(200, '\n'))), IsEmpty());
    EXPECT_THAT(faults_of_length(with("sim/a.h", std::string(201, '\n'))),
                ElementsAre("sim/a.h has 201 lines; a header has at most 200"));
    EXPECT_THAT(faults_of_length(with("sim/a.cpp", std::string(500, '\n'))), IsEmpty());
    EXPECT_THAT(faults_of_length(with("sim/a.cpp", std::string(501, '\n'))),
                ElementsAre("sim/a.cpp has 501 lines; a source has at most 500"));
}

}  // namespace
