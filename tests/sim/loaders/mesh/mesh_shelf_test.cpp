// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Meshes that are read ahead: however many there are, what all their readers together may take
// stays within the memory that is allowed.
#include "sim/loaders/mesh/mesh_shelf.h"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/support/sanitized.h"
#include "tests/support/temp_dir.h"

namespace scipd::sim {
namespace {

constexpr std::size_t faces = 650'000;

/// More than 4 MB of it, so that no two are read by one child.
std::string large_obj() {
    std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (std::size_t i = 0; i < faces; ++i)
        text += "f 1 2 3\n";
    return text;
}

/// How many children this process has, by any of its threads.
std::ptrdiff_t children() {
    std::ptrdiff_t count = 0;
    for (const auto& task : std::filesystem::directory_iterator{"/proc/self/task"}) {
        std::ifstream list{task.path() / "children"};
        count += std::distance(std::istream_iterator<pid_t>{list}, {});
    }
    return count;
}

/// How many children there were at once, as far as somebody saw who looked all the time.
std::ptrdiff_t most_children_reading(MeshShelf& shelf, const std::vector<MeshSource>& sources) {
    std::ptrdiff_t most = 0;
    const std::jthread looks([&most](const std::stop_token& stop) {
        while (!stop.stop_requested()) {
            most = std::max(most, children());
            std::this_thread::sleep_for(std::chrono::milliseconds{1});
        }
    });
    shelf.read_ahead(sources);
    return most;
}

TEST(MeshShelf, ReadsAsManyAtATimeAsTheMemoryIsFor) {
    if (tests::sanitized) GTEST_SKIP() << tests::sanitizers_take_time;
    const tests::TempDir folder;
    const std::string text = large_obj();
    std::vector<MeshSource> sources;
    for (const char* name : {"a.obj", "b.obj", "c.obj"})
        sources.push_back({folder.write(name, text), ""});
    // Each may take 100 bytes a byte of its file and 1 GiB: two do not fit.
    MeshShelf narrow{10 * faces, {.memory_bytes = std::size_t{2} << 30U}};
    EXPECT_EQ(most_children_reading(narrow, sources), 1);
    for (const MeshSource& source : sources) {
        ASSERT_EQ(narrow.parts_of(source.file, {}).size(), 1U);
        EXPECT_EQ(narrow.parts_of(source.file, {})[0].mesh->triangles.size(), faces);
    }
}

TEST(MeshShelf, ReadsAloneWhatCannotBeReadWithOthers) {
    const tests::TempDir folder;
    const auto good = folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const std::vector<MeshSource> sources{{good, ""}, {folder.write("b.obj", "v 0 0 0\n"), ""}};
    ASSERT_EQ(batches_of(sources).size(), 1U);
    MeshShelf shelf{10, {}};
    shelf.read_ahead(sources);
    EXPECT_EQ(shelf.parts_of(good, {}).size(), 1U);
    EXPECT_THROW(shelf.parts_of(sources[1].file, {}), LoadError);
}

}  // namespace
}  // namespace scipd::sim
