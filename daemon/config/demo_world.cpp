// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/config/demo_world.h"

#include <array>
#include <string>
#include <system_error>

namespace scipd::daemon {

namespace fs = std::filesystem;

namespace {

/// Where scenes/ may be, both handed in by CMake: from bin/ to the data of an installation, and the
/// sources.
std::array<fs::path, 2> scene_folders() {
    std::error_code error;
    const auto program = fs::read_symlink("/proc/self/exe", error);
    return {(program.parent_path() / SCIPD_SCENES_FROM_BIN).lexically_normal(),
            fs::path{SCIPD_SOURCE_SCENES}};
}

/// A file of scenes/. A fault begins with `what`, which it is.
sim::Expected<fs::path> in_scenes(const char* name, const std::string& what) {
    std::string sought;
    for (const auto& folder : scene_folders()) {
        std::error_code error;
        const auto file = folder / name;
        if (fs::exists(file, error)) return file;
        sought += (sought.empty() ? "neither at " : " nor at ") + file.string();
    }
    return sim::refuse(what + " is " + sought);
}

}  // namespace

sim::Expected<fs::path> demo_scene() {
    return in_scenes("rescue_maze.sdf", "name a scene: the demo world");
}

sim::Expected<fs::path> stock_materials() {
    return in_scenes("materials.yaml", "the library of materials that comes with scipd");
}

std::vector<fs::path> stock_models() {
    std::vector<fs::path> folders;
    for (const auto& folder : scene_folders())
        folders.push_back(folder / "models");
    return folders;
}

sim::Pose demo_start() {
    return sim::pose_from_rpy({1.0, 1.0, 0.0}, {0.0, 0.0, 0.0});
}

sim::Pose demo_mount() {
    return sim::pose_from_rpy({0.0, 0.0, 0.25}, {0.0, 0.0, 0.0});
}

}  // namespace scipd::daemon
