// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipbench/capacity_world.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <stdexcept>
#include <system_error>

#include <sys/resource.h>

#include "daemon/config/demo_world.h"
#include "sim/backends/registry.h"
#include "sim/loaders/scene_file.h"
#include "tools/scipbench/capacity_site.h"
#include "tools/scipbench/free_poses.h"

namespace scipd::tools {
namespace {

/// For how many scanners they are enough: scipd has two sockets for each.
int raise_descriptors() {
    constexpr rlim_t others = 100;
    constexpr rlim_t of_a_scanner = 2;
    constexpr rlim_t most = 20'000;  // a system has about as many free ports for connections
    rlimit limit{};
    if (::getrlimit(RLIMIT_NOFILE, &limit) != 0)
        throw std::system_error(errno, std::generic_category(), "the limit of descriptors");
    limit.rlim_cur = limit.rlim_max;
    ::setrlimit(RLIMIT_NOFILE, &limit);
    if (limit.rlim_max < others + of_a_scanner)
        throw std::runtime_error("there are too few descriptors; raise them with ulimit -Hn");
    return static_cast<int>(std::min((limit.rlim_max - others) / of_a_scanner, most));
}

std::unique_ptr<sim::RangeBackend> rays_into(const std::filesystem::path& scene) {
    const auto loaded = sim::load_scene(scene, {.sdf = {.model_folders = daemon::stock_models()}});
    return sim::preferred_backend().make(loaded.scene, {});
}

}  // namespace

CapacityWorld::CapacityWorld(const std::filesystem::path& scene)
    : backend_(rays_into(scene)), most_(raise_descriptors()) {}

std::vector<sim::Pose> CapacityWorld::places(int robots) {
    std::vector<sim::Pose> places;
    for (const sim::Pose& free :
         free_poses(*backend_, static_cast<std::size_t>(robots), scanner_height_m)) {
        const double yaw_rad = 2.0 * std::atan2(free.rotation.z, free.rotation.w);
        places.push_back(sim::pose_from_rpy({free.translation_m.x, free.translation_m.y, 0.0},
                                            {0.0, 0.0, yaw_rad}));
    }
    return places;
}

}  // namespace scipd::tools
