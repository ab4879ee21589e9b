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

}  // namespace

sim::Expected<fs::path> demo_scene() {
    std::string sought;
    for (const auto& folder : scene_folders()) {
        std::error_code error;
        const auto scene = folder / "rescue_maze.sdf";
        if (fs::exists(scene, error)) return scene;
        sought += (sought.empty() ? "neither at " : " nor at ") + scene.string();
    }
    return sim::refuse("name a scene: the demo world is " + sought);
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
