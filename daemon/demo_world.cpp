// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/demo_world.h"

#include <stdexcept>
#include <system_error>

namespace scipd::daemon {

namespace fs = std::filesystem;

fs::path demo_scene() {
    std::error_code error;
    const auto program = fs::read_symlink("/proc/self/exe", error);
    // Both places are handed in by CMake: from bin/ to the data of an installation, and the
    // sources.
    const auto installed =
        (program.parent_path() / SCIPD_SCENES_FROM_BIN / "rescue_maze.sdf").lexically_normal();
    const fs::path source = fs::path{SCIPD_SOURCE_SCENES} / "rescue_maze.sdf";
    for (const auto& scene : {installed, source}) {
        if (fs::exists(scene, error)) return scene;
    }
    throw std::invalid_argument("name a scene: the demo world is neither at " + installed.string() +
                                " nor at " + source.string());
}

sim::Pose demo_start() {
    return sim::pose_from_rpy({1.0, 1.0, 0.0}, {0.0, 0.0, 0.0});
}

sim::Pose demo_mount() {
    return sim::pose_from_rpy({0.0, 0.0, 0.25}, {0.0, 0.0, 0.0});
}

}  // namespace scipd::daemon
