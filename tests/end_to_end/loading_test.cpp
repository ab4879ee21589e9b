// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Worlds that take long to load. Ending scipd must not wait for them.
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/end_to_end/in_square_room.h"
#include "tests/support/child.h"

namespace scipd::tests {
namespace {

using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

class Loading : public testing::Test {
  protected:
    /// Its meshes take several seconds, though it is one file under many names.
    fs::path large_world() {
        constexpr int side = 500;
        std::string obj;
        for (int i = 0; i <= side * side; ++i)
            obj += "v " + std::to_string(i % side) + ' ' + std::to_string(i / side) + " 0\n";
        for (int i = 1; i < side * (side - 1); ++i) {
            obj += "f " + std::to_string(i) + ' ' + std::to_string(i + 1) + ' ' +
                   std::to_string(i + side) + '\n';
        }
        const fs::path mesh = directory_.write("mesh.obj", obj);
        std::string visuals;
        for (int i = 0; i < 30; ++i) {
            const std::string name = std::to_string(i) + ".obj";
            fs::create_hard_link(mesh, directory_.path() / name);
            visuals += "<visual name='" + name + "'><geometry><mesh><uri>" + name +
                       "</uri></mesh></geometry></visual>\n";
        }
        return directory_.write("large.sdf", "<sdf version='1.9'><model name='m'><link name='l'>" +
                                                 visuals + "</link></model></sdf>");
    }

    fs::path write(const fs::path& world) {
        return directory_.write("rig.yaml", "scene: " + world.string() +
                                                "\ncontrol: control.sock\nrobots: {r: {sensors: "
                                                "{s: {model: UST-10LX, tcp: 127.0.0.1:0}}}}\n");
    }

    /// Waits long enough for scipd to begin to load.
    static void wait_a_little() { std::this_thread::sleep_for(std::chrono::milliseconds{500}); }

    TempDir directory_;
};

// The signal itself must end it. A scipd that only noted the signal would exit with 0 after
// loading.
TEST_F(Loading, EndsAtOnceAtTheStart) {
    const fs::path file = write(large_world());
    for (const char* how : {"--config", "--check"}) {
        Child scipd({SCIPD_PROGRAM, how, file});
        wait_a_little();
        scipd.signal(SIGTERM);
        EXPECT_EQ(scipd.wait().exit_code, -1) << how;
        EXPECT_FALSE(fs::exists(directory_.path() / "control.sock"));
    }
}

TEST_F(Loading, EndsAtOnceWhileScannersRun) {
    DaemonProcess daemon(directory_, {"--config", write(scene("square_room.sdf"))});
    ASSERT_NE(daemon.ready_line(), "") << daemon.standard_error();
    write(large_world());
    daemon.signal(SIGHUP);
    wait_a_little();
    const auto begin = std::chrono::steady_clock::now();
    daemon.signal(SIGTERM);
    EXPECT_EQ(daemon.wait(), 0);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds{5});
    EXPECT_THAT(daemon.standard_error(), Not(HasSubstr("SIGHUP")));
}

// 100 includes of 100 visuals each.
TEST_F(Loading, RefusesWhatTakesTooMuchAndTakesItWhereItMay) {
    std::string visuals;
    std::string includes;
    for (int i = 0; i < 100; ++i) {
        const std::string n = std::to_string(i);
        visuals +=
            "<visual name='v" + n + "'><geometry><box><size>1 1 1</size></box></geometry></visual>";
        includes += "<include><uri>part.sdf</uri><name>m" + n + "</name><pose>" + n +
                    " 0 0 0 0 0</pose></include>";
    }
    directory_.write("part.sdf", "<sdf version='1.9'><model name='m'><link name='l'>" + visuals +
                                     "</link></model></sdf>");
    const fs::path world = directory_.write(
        "world.sdf", "<sdf version='1.9'><world name='w'>" + includes + "</world></sdf>");
    const auto checked = [&](const std::string& limits) {
        const fs::path file = write(world);
        std::ofstream{file, std::ios::app} << limits;
        return run({SCIPD_PROGRAM, "--check", file});
    };
    const Outcome refused = checked("limits: {world_memory_mb: 5}\n");
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, HasSubstr("takes more than the 5 MB that are allowed"));
    EXPECT_THAT(refused.err, HasSubstr("world_memory_mb under limits"));
    const Outcome usual = checked("");
    EXPECT_EQ(usual.exit_code, 0) << usual.err;
    EXPECT_THAT(checked("limits: {world_load_s: 0}\n").err, HasSubstr("limits.world_load_s"));
}

}  // namespace
}  // namespace scipd::tests
