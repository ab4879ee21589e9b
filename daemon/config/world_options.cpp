// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/config/world_options.h"

#include <algorithm>
#include <array>
#include <string>

#include "daemon/config/members.h"
#include "daemon/config/numbers.h"
#include "daemon/config/values.h"
#include "sim/text/likely_unit.h"

namespace scipd::daemon {
namespace {

constexpr std::array<std::string_view, 3> map_keys{"z", "material", "unknown"};
constexpr std::array<std::string_view, 4> world_keys{"world_memory_mb", "world_triangles",
                                                     "world_overlap", "world_load_s"};

sim::Expected<sim::UnknownCells> parse_unknown(std::string_view text) {
    if (text == "free") return sim::UnknownCells::free;
    if (text == "wall") return sim::UnknownCells::wall;
    if (text == "unknown") return sim::UnknownCells::unknown;
    return sim::refuse("must be free, wall or unknown, not '" + std::string(text) + "'");
}

void read_heights(const sim::YamlField& field, sim::MapOptions& options, sim::YamlFaults& faults) {
    const std::string advice = "must be the heights of the walls, [BOTTOM, TOP], such as [0, 2]";
    const auto heights_m = sim::numbers_of(field.value, 2, parse_metres, advice);
    if (!heights_m) return faults.add(field, heights_m.error().why);
    options.bottom_m = heights_m->front();
    options.top_m = heights_m->back();
    if (options.bottom_m >= options.top_m) faults.add(field, advice);
    constexpr double higher_than_any_m = 500.0;
    if (options.top_m - options.bottom_m >= higher_than_any_m &&
        sim::could_be_millimetres(*heights_m))
        faults.warn(field, sim::millimetres_for_metres(*heights_m));
}

sim::Expected<std::size_t> parse_megabytes(std::string_view text) {
    constexpr int most = 1'000'000;
    constexpr std::size_t megabyte = 1'000'000;
    return parse_whole(text, 1, most).map([](int megabytes) {
        return megabyte * static_cast<std::size_t>(megabytes);
    });
}

sim::Expected<std::size_t> parse_triangles(std::string_view text) {
    constexpr int most = 1'000'000'000;
    return parse_whole(text, 1, most).map([](int triangles) {
        return static_cast<std::size_t>(triangles);
    });
}

/// Fewer than a handful of things could not stand behind each other.
sim::Expected<std::size_t> parse_overlap(std::string_view text) {
    constexpr int least = 100;
    constexpr int most = 1'000'000'000;
    return parse_whole(text, least, most).map([](int triangles) {
        return static_cast<std::size_t>(triangles);
    });
}

sim::Expected<std::chrono::seconds> parse_load_time(std::string_view text) {
    constexpr int a_day_s = 86'400;
    return parse_whole(text, 1, a_day_s).map([](int time_s) {
        return std::chrono::seconds(time_s);
    });
}

}  // namespace

sim::MapOptions read_map(const sim::YamlField& field, sim::YamlFaults& faults) {
    const sim::YamlSection section{field, map_keys, faults};
    sim::MapOptions options;
    if (const sim::YamlField* z = section.find("z")) read_heights(*z, options, faults);
    section.read("material", options.material);
    section.read("unknown", options.unknown, parse_unknown);
    return options;
}

sim::XacroArguments read_xacro(const sim::YamlField& field, sim::YamlFaults& faults) {
    sim::XacroArguments arguments;
    for (const sim::YamlField& entry : entries(field, faults)) {
        const auto argument = sim::text_of(entry.value).and_then([&](const std::string& value) {
            return parse_xacro_argument(entry.key + ":=" + value);
        });
        faults.require(entry, argument.map([&](const auto& good) { arguments.insert(good); }));
    }
    return arguments;
}

void read_limits(const sim::YamlField& field, Config& config, sim::YamlFaults& faults) {
    const sim::YamlSection section{field, keys_of(limit_table, world_keys), faults};
    WorldLimits& world = config.limits;
    section.read("world_memory_mb", world.memory_bytes, parse_megabytes);
    section.read("world_triangles", world.triangles, parse_triangles);
    section.read("world_overlap", world.overlap, parse_overlap);
    section.read("world_load_s", world.load_time, parse_load_time);
    for (std::size_t i = 0; i < limit_table.size(); ++i) {
        const LimitRow& row = limit_table[i];
        section.read(row.key, config.client_limits.values[i],
                     [&](std::string_view text) { return parse_whole(text, row.least, row.most); });
    }
}

void apply(const WorldLimits& limits, sim::SceneOptions& options) {
    sim::MeshLimits& mesh = options.sdf.mesh;
    options.sdf.most_memory_bytes = limits.memory_bytes;
    options.sdf.most_triangles = limits.triangles;
    options.most_overlap = limits.overlap;
    options.limits.wall_time = limits.load_time;
    if (limits.triangles > WorldLimits{}.triangles) mesh.triangles = limits.triangles;
    mesh.triangles = std::min(mesh.triangles, limits.triangles);
    mesh.memory_bytes = limits.memory_bytes;
    // The limits are estimates; the process that loads the world is held to twice as much.
    const std::size_t held_bytes = 2 * limits.memory_bytes;
    options.limits.memory_bytes = std::max(options.limits.memory_bytes, held_bytes);
}

}  // namespace scipd::daemon
