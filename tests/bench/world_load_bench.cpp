// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Measures how long a world of 100 included models with 1 M triangles takes to load. It compares
// with the bare calls of Assimp, with the same steps, for the same meshes. Both run in turns, each
// time in a process of its own. Then it loads a world of 2 000 models of one box.
//
//   build/release/bin/world_load_bench [ROUNDS]
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "sim/loaders/scene_file.h"
#include "tests/bench/big_worlds.h"
#include "tests/bench/rounds.h"
#include "tests/support/temp_dir.h"

namespace {

using namespace scipd;
namespace fs = std::filesystem;

constexpr int models = 100;
constexpr int side = 71;  // 10 082 triangles each

std::string name_of(int model) {
    return "hill_" + std::to_string(model);
}

fs::path mesh_of(const fs::path& folder, int model, const std::string& kind) {
    return folder / name_of(model) / ("hill." + kind);
}

void write_model(const fs::path& folder, int model, const std::string& kind) {
    const fs::path here = folder / name_of(model);
    fs::create_directories(here);
    bench::write_terrain(mesh_of(folder, model, kind), side);
    std::ofstream{here / "model.config"} << "<model><name>" << name_of(model)
                                         << "</name><sdf version='1.9'>model.sdf</sdf></model>";
    std::ofstream{here / "model.sdf"}
        << "<sdf version='1.9'><model name='" << name_of(model)
        << "'><static>1</static><link name='l'><visual name='v'><geometry><mesh><uri>model://"
        << name_of(model) << "/hill." << kind
        << "</uri></mesh></geometry></visual></link></model></sdf>";
}

fs::path write_world(const fs::path& folder, const std::string& kind) {
    const fs::path file = folder / "world.sdf";
    std::ofstream out{file};
    out << "<sdf version='1.9'><world name='w'>";
    for (int model = 0; model < models; ++model) {
        write_model(folder, model, kind);
        out << "<include><uri>model://" << name_of(model) << "</uri><pose>" << 20 * (model % 10)
            << ' ' << 20 * (model / 10) << " 0 0 0 0</pose></include>";
    }
    out << "</world></sdf>";
    return file;
}

/// The least that any program must ask of the library to get triangles.
void read_mesh_bare(const fs::path& file) {
    Assimp::Importer importer;
    importer.SetPropertyInteger(
        AI_CONFIG_PP_RVC_FLAGS,
        aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS | aiComponent_COLORS |
            aiComponent_TEXCOORDS | aiComponent_BONEWEIGHTS | aiComponent_ANIMATIONS |
            aiComponent_TEXTURES | aiComponent_LIGHTS | aiComponent_CAMERAS);
    const aiScene* scene = importer.ReadFile(
        file, aiProcess_Triangulate | aiProcess_RemoveComponent | aiProcess_PreTransformVertices |
                  aiProcess_SortByPType | aiProcess_ValidateDataStructure |
                  aiProcess_JoinIdenticalVertices);
    if (scene == nullptr) throw std::runtime_error(importer.GetErrorString());
}

void load_bare(const fs::path& folder, const std::string& kind) {
    for (int model = 0; model < models; ++model)
        read_mesh_bare(mesh_of(folder, model, kind));
}

fs::path write_boxes(const fs::path& folder) {
    const fs::path file = folder / "boxes.sdf";
    std::ofstream out{file};
    out << "<sdf version='1.12'><world name='w'>";
    for (int i = 0; i < 2000; ++i) {
        out << "<model name='m" << i << "'><pose>" << 2 * (i % 40) << ' ' << 2 * (i / 40)
            << " 0 0 0 0</pose><link name='l'><visual name='v'><geometry><box><size>1 1 1</size>"
               "</box></geometry></visual></link></model>";
    }
    out << "</world></sdf>";
    return file;
}

struct Cost {
    double passed_s;
    double processor_s;  ///< of all processors; other load affects it little
    double peak_mb;      ///< of the process itself
};

double processor_s() {
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    const auto seconds = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Works in a child, so that what one load leaves in memory does not help the next.
Cost cost_alone(const std::function<void()>& work) {
    std::fflush(stdout);
    const double before_s = processor_s();
    rusage usage{};
    const double passed_s = seconds_for([&] {
        const pid_t child = fork();
        if (child == 0) {
            try {
                work();
                _exit(0);
            } catch (const std::exception& error) {
                std::fprintf(stderr, "%s\n", error.what());
                _exit(1);
            }
        }
        int status = 0;
        if (wait4(child, &status, 0, &usage) != child || status != 0) std::exit(1);
    });
    return {passed_s, processor_s() - before_s, static_cast<double>(usage.ru_maxrss) / 1000.0};
}

using Part = double Cost::*;

double median_of(const std::vector<Cost>& costs, Part part) {
    std::vector<double> values;
    for (const Cost& cost : costs)
        values.push_back(cost.*part);
    return median(values);
}

}  // namespace

int main(int argc, char** argv) {
    const int rounds = argc > 1 ? std::atoi(argv[1]) : 5;
    std::puts("medians in s         bare    ours   ratio   processors: bare    ours   ratio");
    for (const char* kind : {"dae", "obj", "stl"}) {
        const tests::TempDir folder;
        const fs::path world = write_world(folder.path(), kind);
        std::vector<Cost> bare;
        std::vector<Cost> ours;
        for (int round = 0; round < rounds; ++round) {
            bare.push_back(cost_alone([&] { load_bare(folder.path(), kind); }));
            ours.push_back(cost_alone([&] { sim::load_scene(world); }));
        }
        std::printf("%-17s", kind);
        for (const auto part : {&Cost::passed_s, &Cost::processor_s}) {
            const double bare_s = median_of(bare, part);
            const double ours_s = median_of(ours, part);
            std::printf(" %7.2f %7.2f %7.2f            ", bare_s, ours_s, ours_s / bare_s);
        }
        std::puts("");
        std::fflush(stdout);
    }
    const tests::TempDir folder;
    const fs::path boxes = write_boxes(folder.path());
    std::vector<Cost> ours;
    for (int round = 0; round < rounds; ++round)
        ours.push_back(cost_alone([&] { sim::load_scene(boxes); }));
    std::printf("2000 boxes: %.2f s, %.0f MB\n", median_of(ours, &Cost::passed_s),
                median_of(ours, &Cost::peak_mb));
}
