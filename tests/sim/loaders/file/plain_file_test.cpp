// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What stands where a file is wanted and would block whoever opens it.
#include "sim/loaders/file/plain_file.h"

#include <functional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include "sim/loaders/poses/trajectory_file.h"
#include "sim/loaders/scene_file.h"
#include "tests/sim/loaders/faults_of.h"
#include "tests/sim/loaders/sdf/sdf_text.h"
#include "tests/support/why_not.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using tests::why_not;

class PlainFile : public ::testing::Test {
  protected:
    /// What waits for somebody to write into a FIFO ends the test.
    PlainFile() { alarm(60); }
    ~PlainFile() override { alarm(0); }

    fs::path fifo(const std::string& name) {
        const auto path = folder_.path() / name;
        fs::create_directories(path.parent_path());
        EXPECT_EQ(mkfifo(path.c_str(), 0600), 0);
        return path;
    }

    fs::path device(const std::string& name) {
        const auto path = folder_.path() / name;
        fs::create_symlink("/dev/zero", path);
        return path;
    }

    std::vector<std::string> scene_faults(const fs::path& file) {
        return faults_of([&] { load_scene(file, {.sdf = {.strict = true}}); }, folder_);
    }

    TempDir folder_;
};

TEST_F(PlainFile, saysWhatElseItIs) {
    EXPECT_EQ(why_not(check_plain_file(folder_.write("file", ""))), std::nullopt);
    EXPECT_EQ(why_not(check_plain_file(folder_.path() / "gone")), "no such file");
    EXPECT_EQ(why_not(check_plain_file(folder_.path() / "file/in")), "no such file");
    EXPECT_EQ(why_not(check_plain_file(folder_.path())), "is a directory");
    EXPECT_EQ(why_not(check_plain_file(fifo("fifo"))), "is a FIFO");
    EXPECT_EQ(why_not(check_plain_file("/dev/null")), "is a device");
    EXPECT_THROW(open_file(folder_.path() / "fifo"), std::runtime_error);

    const int descriptor = socket(AF_UNIX, SOCK_STREAM, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    (folder_.path() / "socket").string().copy(address.sun_path, sizeof address.sun_path - 1);
    ASSERT_EQ(bind(descriptor, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(why_not(check_plain_file(folder_.path() / "socket")), "is a socket");
    close(descriptor);
}

TEST_F(PlainFile, isReadUpToASize) {
    const auto file = folder_.write("file", "12345");
    EXPECT_EQ(read_file(file, 5, "x"), "12345");
    fs::resize_file(file, std::uintmax_t{5} << 40U);  // sparse: it takes no room
    EXPECT_THAT(faults_of([&] { read_file(file, 3U << 20U, "name another"); }, folder_),
                ElementsAre("file: is larger than 3 MiB; name another"));
}

TEST_F(PlainFile, isWantedOfEveryWorld) {
    EXPECT_THAT(scene_faults(fifo("a.sdf")),
                ElementsAre("a.sdf: is a FIFO; name an SDF world or model"));
    EXPECT_THAT(scene_faults(device("b.world")),
                ElementsAre("b.world: is a device; name an SDF world or model"));
    EXPECT_THAT(scene_faults(fifo("a.urdf")),
                ElementsAre("a.urdf: is a FIFO; name an SDF world or model"));
    EXPECT_THAT(scene_faults(fifo("a.yaml")),
                ElementsAre("a.yaml: is a FIFO; name the YAML of a ROS map"));
    EXPECT_THAT(scene_faults(device("b.yaml")),
                ElementsAre("b.yaml: is a device; name the YAML of a ROS map"));
    EXPECT_THAT(scene_faults(fifo("a.stl")),
                ElementsAre("a.stl: is a FIFO; a mesh is wanted here"));
}

TEST_F(PlainFile, isWantedOfAMapsPicture) {
    const std::string rest = "\nresolution: 1\norigin: [0, 0, 0]\nnegate: 0\n";
    fifo("a.pgm");
    EXPECT_THAT(scene_faults(folder_.write("a.yaml", "image: a.pgm" + rest)),
                ElementsAre("a.pgm: is a FIFO; the map's picture is wanted here"));
    device("b.png");
    EXPECT_THAT(scene_faults(folder_.write("b.yaml", "image: b.png" + rest)),
                ElementsAre("b.png: is a device; the map's picture is wanted here"));
    EXPECT_THAT(scene_faults(folder_.write("c.yaml", "image: ." + rest)),
                ElementsAre(HasSubstr("is a directory; the map's picture is wanted here")));
}

TEST_F(PlainFile, isWantedOfATrajectory) {
    EXPECT_THAT(faults_of([&] { load_trajectory(fifo("a.tum")); }, folder_),
                ElementsAre("a.tum: is a FIFO; name a trajectory"));
    EXPECT_THAT(faults_of([&] { load_trajectory(device("b.tum")); }, folder_),
                ElementsAre("b.tum: is a device; name a trajectory"));
}

TEST_F(PlainFile, isWantedOfAllThatAWorldNames) {
    fifo("pipe");
    fifo("model/model.config");
    folder_.write("other/model.config", "<model><sdf version='1.9'>x.sdf</sdf></model>");
    fifo("other/x.sdf");
    const auto include = [](const std::string& uri) {
        return "<include><uri>" + uri + "</uri></include>\n";
    };
    EXPECT_THAT(scene_faults(folder_.write("a.sdf", world(include("pipe") + include("/dev/zero") +
                                                          include("model") + include("other")))),
                ElementsAre("a.sdf:4: 'pipe' is a FIFO", "a.sdf:5: '/dev/zero' is a device",
                            "a.sdf:6: 'model' is the folder model, which has no model.config that "
                            "names an SDF file",
                            "a.sdf:7: 'other' is the folder other, which has no model.config that "
                            "names an SDF file"));
    fifo("pipe.obj");
    EXPECT_THAT(
        scene_faults(folder_.write("b.sdf", world(model_of(visual("v", mesh_of("pipe.obj")))))),
        ElementsAre(HasSubstr("m::l::v: pipe.obj: is a FIFO; a mesh is wanted here")));
}

}  // namespace
}  // namespace scipd::sim
