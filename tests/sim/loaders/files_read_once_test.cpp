// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// However often a world shows what a file holds, the file is opened as often as for showing it
// once.
#include <array>
#include <cstddef>
#include <cstring>
#include <string>

#include <gtest/gtest.h>
#include <sys/inotify.h>
#include <unistd.h>

#include "sim/loaders/scene_file.h"
#include "tests/sim/loaders/sdf/sdf_text.h"
#include "tests/support/temp_dir.h"

namespace scipd::sim {
namespace {

/// From its birth on, by any process.
class Openings {
  public:
    explicit Openings(const std::filesystem::path& file) {
        // With the closings, since equal events that follow each other become one.
        inotify_add_watch(queue_, file.c_str(), IN_OPEN | IN_CLOSE);
    }
    ~Openings() { close(queue_); }
    Openings(const Openings&) = delete;
    Openings& operator=(const Openings&) = delete;

    [[nodiscard]] int count() const {
        std::array<char, 4096> events{};
        int count = 0;
        for (auto size = read(queue_, events.data(), events.size()); size > 0;
             size = read(queue_, events.data(), events.size())) {
            // The events of a file, unlike those of a folder, have no name behind them.
            for (std::size_t at = 0; at < static_cast<std::size_t>(size);
                 at += sizeof(inotify_event)) {
                inotify_event event{};
                std::memcpy(&event, &events[at], sizeof event);
                count += (event.mask & IN_OPEN) != 0 ? 1 : 0;
            }
        }
        return count;
    }

  private:
    int queue_ = inotify_init1(IN_NONBLOCK);
};

std::string mesh_scaled(const std::string& scale) {
    return "<mesh><uri>thing.obj</uri><scale>" + scale + "</scale></mesh>";
}

int openings_for(const std::filesystem::path& file, const std::filesystem::path& world_file) {
    const Openings openings{file};
    load_scene(world_file);
    return openings.count();
}

TEST(FilesReadOnce, holdsForMeshesAtSeveralScales) {
    const tests::TempDir folder;
    const auto mesh = folder.write("thing.obj", triangle_obj);
    const auto once = folder.write("once.sdf", world(model_of(visual("a", mesh_scaled("1 1 1")))));
    const auto often = folder.write(
        "often.sdf",
        world(model_of(visual("a", mesh_scaled("1 1 1")) + visual("b", mesh_scaled("1 1 1")) +
                       visual("c", mesh_scaled("2 2 2")) + visual("d", mesh_scaled("3 1 1")))));
    const int wanted = openings_for(mesh, once);
    EXPECT_GT(wanted, 0);
    EXPECT_EQ(openings_for(mesh, often), wanted);
}

TEST(FilesReadOnce, holdsForIncludedModels) {
    const tests::TempDir folder;
    folder.write("thing/model.config",
                 "<model><name>thing</name><sdf version='1.9'>model.sdf</sdf></model>");
    const auto model = folder.write("thing/model.sdf", sdf(model_of(visual("v", unit_box))));
    std::string includes;
    for (const char* name : {"a", "b", "c"})
        includes +=
            "<include><uri>model://thing</uri><name>" + std::string{name} + "</name></include>";
    EXPECT_EQ(openings_for(model, folder.write("a.sdf", world(includes))), 1);
}

}  // namespace
}  // namespace scipd::sim
