// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/config/limits.h"

#include <algorithm>
#include <array>

#include "daemon/config/numbers.h"

namespace scipd::daemon {
namespace {

constexpr std::array<std::string_view, 3> limits_keys{"world_memory_mb", "world_triangles",
                                                      "world_load_s"};

std::size_t parse_megabytes(std::string_view text) {
    constexpr int most = 1'000'000;
    constexpr std::size_t megabyte = 1'000'000;
    return megabyte * static_cast<std::size_t>(parse_whole(text, 1, most));
}

std::size_t parse_triangles(std::string_view text) {
    constexpr int most = 1'000'000'000;
    return static_cast<std::size_t>(parse_whole(text, 1, most));
}

std::chrono::seconds parse_load_time(std::string_view text) {
    constexpr int a_day_s = 86'400;
    return std::chrono::seconds(parse_whole(text, 1, a_day_s));
}

}  // namespace

WorldLimits read_limits(const Field& field, Faults& faults) {
    const Section section{field, {limits_keys, {}}, faults};
    WorldLimits limits;
    section.read("world_memory_mb", limits.memory_bytes, parse_megabytes);
    section.read("world_triangles", limits.triangles, parse_triangles);
    section.read("world_load_s", limits.load_time, parse_load_time);
    return limits;
}

void apply(const WorldLimits& limits, sim::SceneOptions& options) {
    sim::MeshLimits& mesh = options.sdf.mesh;
    options.sdf.most_memory_bytes = limits.memory_bytes;
    options.sdf.most_triangles = limits.triangles;
    options.limits.wall_time = limits.load_time;
    if (limits.triangles > WorldLimits{}.triangles) mesh.triangles = limits.triangles;
    mesh.triangles = std::min(mesh.triangles, limits.triangles);
    mesh.memory_bytes = limits.memory_bytes;
    // An estimate is none to hold the child to that loads the world.
    const std::size_t held_bytes = 2 * limits.memory_bytes;
    options.limits.memory_bytes = std::max(options.limits.memory_bytes, held_bytes);
}

}  // namespace scipd::daemon
