// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Any bytes as the YAML of a ROS map: the result is a usable map or faults that can be shown.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "sim/loaders/file/load_error.h"
#include "sim/loaders/map/map_file.h"

namespace {

using namespace scipd::sim;

void require(bool holds) {
    if (!holds) std::abort();
}

void check(const MapFile& map) {
    require(!map.image.empty());
    require(map.resolution_m >= 1e-4 && map.resolution_m <= 1e3);
    require(std::abs(map.origin_m.x) <= 1e7 && std::abs(map.origin_m.y) <= 1e7);
    require(std::isfinite(map.yaw_rad));
    require(map.free_below >= 0.0 && map.free_below <= map.occupied_above);
    require(map.occupied_above <= 1.0);
}

void check(const LoadError& error) {
    require(!error.faults().empty());
    for (const auto& fault : error.faults()) {
        require(fault.starts_with("map.yaml:"));
        for (const char c : fault)
            require(c >= ' ' && c <= '~');
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text{reinterpret_cast<const char*>(data), size};
    try {
        check(parse_map_file(text, "map.yaml"));
    } catch (const LoadError& error) {
        check(error);
    }
    return 0;
}
