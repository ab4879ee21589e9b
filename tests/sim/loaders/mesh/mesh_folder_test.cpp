// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Which files a mesh may have opened: plain ones, beside it. Where a test would hang, the deadline
// ends it in other words than these.
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "sim/loaders/mesh/mesh_parts.h"
#include "tests/sim/loaders/faults_of.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

std::string obj_with(const std::string& mtllib) {
    return "mtllib " + mtllib + "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl oak\nf 1 2 3\n";
}

/// One triangle, whose corners are the first bytes of the file that it names.
std::string gltf_with(const std::string& uri) {
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
           R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
           R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],)"
           R"("bufferViews":[{"buffer":0,"byteLength":36}],)"
           R"("buffers":[{"byteLength":36,"uri":")" +
           uri + "\"}]}";
}

/// Three corners, in the bytes of floats.
std::string corner_bytes() {
    const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    return {reinterpret_cast<const char*>(corners), sizeof corners};
}

class MeshFolderTest : public ::testing::Test {
  protected:
    fs::path fifo(const std::string& name) {
        const auto path = folder_.path() / name;
        EXPECT_EQ(mkfifo(path.c_str(), 0600), 0);
        return path;
    }

    std::vector<MeshPart> parts(const fs::path& mesh) {
        return load_mesh_parts(mesh, glm::dvec3{1.0}, MeshAxes::as_in_file,
                               {.wall_time = std::chrono::seconds{20}});
    }

    std::vector<std::string> faults(const fs::path& mesh) {
        return faults_of([&] { parts(mesh); }, folder_);
    }

    std::vector<std::string> faults(const std::string& name, const std::string& text) {
        return faults(folder_.write(name, text));
    }

    TempDir folder_;
};

TEST_F(MeshFolderTest, aMaterialFileThatIsNoneIsLeftUnread) {
    fifo("pipe.mtl");
    fs::create_symlink("/dev/zero", folder_.path() / "zero.mtl");
    fs::create_directory(folder_.path() / "folder.mtl");
    folder_.write("outside.mtl", "newmtl oak\n");
    for (const std::string mtl :
         {"pipe.mtl", "zero.mtl", "folder.mtl", "gone.mtl", "../outside.mtl", "/etc/shadow"}) {
        SCOPED_TRACE(mtl);
        const auto read =
            parts(folder_.write(mtl == "../outside.mtl" ? "in/a.obj" : "a.obj", obj_with(mtl)));
        ASSERT_EQ(read.size(), 1U);
        EXPECT_EQ(read[0].material, "oak");
        EXPECT_EQ(read[0].mesh.triangles.size(), 1U);
    }
}

TEST_F(MeshFolderTest, aBufferThatIsNoFileIsRefused) {
    fifo("pipe.bin");
    fs::create_symlink("/dev/zero", folder_.path() / "zero.bin");
    fs::create_symlink("pipe.bin", folder_.path() / "link.bin");
    EXPECT_THAT(faults("a.gltf", gltf_with("pipe.bin")),
                ElementsAre(HasSubstr("it names 'pipe.bin', which is a FIFO")));
    EXPECT_THAT(faults("a.gltf", gltf_with("link.bin")),
                ElementsAre(HasSubstr("it names 'link.bin', which is a FIFO")));
    EXPECT_THAT(faults("a.gltf", gltf_with("zero.bin")),
                ElementsAre(HasSubstr(
                    "it names 'zero.bin', which does not lie in the folder of the mesh")));
}

TEST_F(MeshFolderTest, aBufferMayLieBesideTheMeshAndBelow) {
    folder_.write("b.bin", corner_bytes());
    folder_.write("below/c.bin", corner_bytes());
    for (const std::string uri : {"b.bin", "below/c.bin", "below/../b.bin"}) {
        EXPECT_THAT(faults("a.gltf", gltf_with(uri)), IsEmpty()) << uri;
    }
}

TEST_F(MeshFolderTest, nothingElsewhereIsRead) {
    folder_.write("secret.bin", corner_bytes());
    folder_.write("in/b.txt", "");
    fs::create_symlink("../secret.bin", folder_.path() / "in/link.bin");
    fs::create_symlink("..", folder_.path() / "in/up");
    for (const auto& uri :
         {std::string{"../secret.bin"}, std::string{"link.bin"}, std::string{"up/secret.bin"},
          (folder_.path() / "secret.bin").string(), std::string{"../in/../secret.bin"}}) {
        EXPECT_THAT(faults("in/a.gltf", gltf_with(uri)),
                    ElementsAre(HasSubstr("cannot be read as a mesh")))
            << uri;
    }
    EXPECT_THAT(faults("in/a.gltf", gltf_with("../secret.bin")),
                ElementsAre(HasSubstr("which does not lie in the folder of the mesh")));
    EXPECT_THAT(faults("in/a.gltf", gltf_with("../gone.bin")),
                ElementsAre(HasSubstr("which does not lie in the folder of the mesh")))
        << "nobody learns what lies elsewhere";
    EXPECT_THAT(faults("in/a.gltf", gltf_with("gone.bin")),
                ElementsAre(HasSubstr("which is not there")));
}

// As `colcon build --symlink-install` and nix do it.
TEST_F(MeshFolderTest, filesThatAreLinkedOneByOneBelongTogether) {
    folder_.write("source/a.gltf", gltf_with("b.bin"));
    folder_.write("source/b.bin", corner_bytes());
    folder_.write("install/c.txt", "");
    for (const char* name : {"a.gltf", "b.bin"})
        fs::create_symlink(folder_.path() / "source" / name, folder_.path() / "install" / name);
    EXPECT_THAT(faults(folder_.path() / "install/a.gltf"), IsEmpty());
}

class NoMesh : public MeshFolderTest, public ::testing::WithParamInterface<std::string> {};

TEST_P(NoMesh, aMeshThatIsNoFileSaysWhatItIs) {
    const std::string name = "a" + GetParam();
    EXPECT_THAT(faults(fifo(name)), ElementsAre(name + ": is a FIFO; a mesh is wanted here"));
    fs::remove(folder_.path() / name);
    fs::create_symlink("/dev/zero", folder_.path() / name);
    EXPECT_THAT(faults(folder_.path() / name),
                ElementsAre(name + ": is a device; a mesh is wanted here"));
    fs::remove(folder_.path() / name);
    fs::create_directory(folder_.path() / name);
    EXPECT_THAT(faults(folder_.path() / name),
                ElementsAre(name + ": is a directory; a mesh is wanted here"));
}

// What somebody's file says is nobody else's business.
TEST_P(NoMesh, aMeshThatIsSomethingElseIsNotQuoted) {
    const std::string name = "a" + GetParam();
    folder_.write("secret", "root:$6$salt$hash:19000:0:99999:7:::\nsecond:*:19000::::::\n");
    fs::create_symlink("secret", folder_.path() / name);
    for (const auto& fault : faults(folder_.path() / name)) {
        EXPECT_THAT(fault, AllOf(Not(HasSubstr("root")), Not(HasSubstr("salt")),
                                 Not(HasSubstr("second")), Not(HasSubstr("19000"))));
    }
    EXPECT_THAT(faults(folder_.path() / name), Not(IsEmpty()));
}

INSTANTIATE_TEST_SUITE_P(Kinds, NoMesh,
                         ::testing::Values(".obj", ".stl", ".ply", ".dae", ".gltf", ".glb"),
                         [](const auto& kind) { return kind.param.substr(1); });

}  // namespace
}  // namespace scipd::sim
