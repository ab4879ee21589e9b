// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/export/ros_map_files.h"

#include <fstream>

#include "sim/export/map_values.h"

namespace scipd::sim {
namespace {

char grey_of(MapCell cell) {
    switch (cell) {
        case MapCell::occupied:
            return '\0';
        case MapCell::free:
            return static_cast<char>(254);
        case MapCell::unknown:
            break;
    }
    return static_cast<char>(205);
}

Expected<> write(const std::filesystem::path& file, const std::string& text) {
    std::ofstream out(file, std::ios::binary);
    out << text;
    if (!out.flush()) return refuse(file.string() + " cannot be written");
    return {};
}

}  // namespace

std::string pgm_of(const FloorMap& map) {
    std::string text =
        "P5\n" + std::to_string(map.columns) + ' ' + std::to_string(map.rows) + "\n255\n";
    text.reserve(text.size() + map.cells.size());
    for (std::size_t row = map.rows; row-- > 0;) {
        for (std::size_t column = 0; column < map.columns; ++column)
            text.push_back(grey_of(map.at(column, row)));
    }
    return text;
}

std::string yaml_of(const FloorMap& map, const std::string& picture) {
    std::string quoted;
    for (const char c : picture)
        quoted += c == '\'' ? std::string{"''"} : std::string{c};
    return "image: '" + quoted + "'\nmode: trinary\nresolution: " + short_text(map.resolution_m) +
           "\norigin: [" + short_text(map.origin_m.x) + ", " + short_text(map.origin_m.y) +
           ", 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
}

Expected<std::string> write_ros_map(const FloorMap& map, const std::filesystem::path& yaml) {
    if (yaml.extension() != ".yaml")
        return refuse(yaml.string() + ": the name must end with .yaml");
    const auto picture = std::filesystem::path{yaml}.replace_extension(".pgm");
    return write(picture, pgm_of(map))
        .and_then([&] { return write(yaml, yaml_of(map, picture.filename())); })
        .map([&] {
            return yaml.string() + " and " + picture.string() + ": " + std::to_string(map.columns) +
                   " x " + std::to_string(map.rows) + " cells of " + short_text(map.resolution_m) +
                   " m" +
                   (map.is_closed ? ""
                                  : "\nno robot stands in free space, so every cell without a wall "
                                    "counts as free, also inside solid objects");
        });
}

}  // namespace scipd::sim
