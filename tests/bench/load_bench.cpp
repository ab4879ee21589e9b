// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Measures how long worlds take to load and how much memory they take: meshes of 10 k, 200 k and 1
// M triangles in each format, and ROS maps of 4000 x 4000 cells, clean and as a robot draws them.
// Each world has a process of its own, whose peak memory counts. The child that reads a mesh is
// counted apart from it.
//
//   build/release/bin/load_bench
#include <chrono>
#include <cstdio>
#include <exception>
#include <functional>
#include <string>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "sim/backends/registry.h"
#include "sim/loaders/scene_file.h"
#include "tests/bench/big_worlds.h"
#include "tests/support/temp_dir.h"

namespace {

using namespace scipd;
using Milliseconds = std::chrono::duration<double, std::milli>;

double peak_mib(__rusage_who who) {
    rusage usage{};
    getrusage(who, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

std::size_t triangle_count(const sim::Scene& scene) {
    std::size_t count = 0;
    for (const auto& object : scene.objects) {
        const auto* mesh = std::get_if<sim::SharedMesh>(&object.shape);
        if (mesh != nullptr) count += (*mesh)->triangles.size();
    }
    return count;
}

/// The processor time of this process and of its children that have ended. Other load on the
/// machine affects it less than the elapsed time.
double processor_ms() {
    double seconds = 0.0;
    for (const auto who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
        rusage usage{};
        getrusage(who, &usage);
        for (const timeval& time : {usage.ru_utime, usage.ru_stime})
            seconds += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    }
    return 1e3 * seconds;
}

void measure(const std::string& title, const std::filesystem::path& file,
             const sim::SceneOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    const sim::SharedScene scene = sim::load_scene(file, options).scene;
    const auto loaded = std::chrono::steady_clock::now();
    const double load_mib = peak_mib(RUSAGE_SELF);
    const double load_processor_ms = processor_ms();
    const auto backend = sim::make_backend("embree", scene);
    const auto built = std::chrono::steady_clock::now();
    std::printf("%-34s %9zu  %6.0f (%5.0f) %6.0f (%5.0f)  %6.0f %6.0f %6.0f\n", title.c_str(),
                triangle_count(*scene), Milliseconds(loaded - start).count(), load_processor_ms,
                Milliseconds(built - start).count(), processor_ms(), load_mib,
                peak_mib(RUSAGE_CHILDREN), peak_mib(RUSAGE_SELF));
}

/// Works in a child, so that the memory of one world is not counted for the next.
bool alone(const std::function<void()>& work) {
    std::fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
        try {
            work();
        } catch (const std::exception& error) {
            std::printf("%s\n", error.what());
            std::fflush(stdout);
            _exit(1);
        }
        std::fflush(stdout);
        _exit(0);
    }
    int status = 0;
    return waitpid(child, &status, 0) == child && status == 0;
}

}  // namespace

int main() {
    const tests::TempDir folder;
    bool good = true;
    std::puts(
        "Times in ms, in brackets of processors alone; memory in MiB.\n"
        "                                   triangles    to the scene  to the backend  "
        " scene reader  peak");
    for (const int side : {71, 317, 708}) {
        for (const char* kind : {"obj", "stl", "ply", "dae", "glb"}) {
            const auto file = folder.path() / ("terrain." + std::string(kind));
            alone([&] { bench::write_terrain(file, side); });
            good &= alone([&] { measure("terrain." + std::string(kind), file, {}); });
        }
    }
    for (const auto& [title, clutter] :
         {std::pair{"map, clean", bench::Clutter::none},
          std::pair{"map, as a robot draws it", bench::Clutter::noisy_and_turned}}) {
        const auto file = folder.path() / "map.yaml";
        alone([&] { bench::write_map(file, 4000, clutter); });
        good &= alone([&] { measure(title, file, {}); });
        good &= alone([&, name = std::string(title) + ", unknown"] {
            measure(name, file, {.map = {.unknown = sim::UnknownCells::unknown}});
        });
    }
    return good ? 0 : 1;
}
