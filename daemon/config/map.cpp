// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/config/map.h"

#include <array>
#include <stdexcept>
#include <string>

#include "daemon/config/numbers.h"

namespace scipd::daemon {
namespace {

constexpr std::array<std::string_view, 3> map_keys{"z", "material", "unknown"};

sim::UnknownCells parse_unknown(std::string_view text) {
    if (text == "free") return sim::UnknownCells::free;
    if (text == "wall") return sim::UnknownCells::wall;
    if (text == "unknown") return sim::UnknownCells::unknown;
    throw std::invalid_argument("must be free, wall or unknown, not '" + std::string(text) + "'");
}

void read_heights(const YAML::Node& value, sim::MapOptions& options) {
    const std::string advice = "must be the heights of the walls, [BOTTOM, TOP], such as [0, 2]";
    if (!value.IsSequence() || value.size() != 2) throw std::invalid_argument(advice);
    options.bottom_m = parse_metres(text_of(value[0]));
    options.top_m = parse_metres(text_of(value[1]));
    if (options.bottom_m >= options.top_m) throw std::invalid_argument(advice);
}

}  // namespace

sim::MapOptions read_map(const Field& field, Faults& faults) {
    const Section section{field, {map_keys, {}}, faults};
    sim::MapOptions options;
    if (const Field* z = section.find("z")) {
        faults.guard(*z, [&] { read_heights(z->value, options); });
    }
    section.read("material", options.material, [](const std::string& text) { return text; });
    section.read("unknown", options.unknown, parse_unknown);
    return options;
}

}  // namespace scipd::daemon
