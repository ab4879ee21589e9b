// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Any bytes as the YAML of a ROS map: the result is a usable map or faults that can be shown.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "sim/loaders/map/map_file.h"
#include "tests/fuzz/load_faults.h"

namespace {

using namespace scipd::sim;
using scipd::tests::require;
using scipd::tests::require_faults_of;

constexpr const char* file = "map.yaml";

void check(const MapFile& map) {
    require(!map.image.empty());
    require(map.resolution_m >= 1e-4 && map.resolution_m <= 1e3);
    require(std::abs(map.origin_m.x) <= 1e7 && std::abs(map.origin_m.y) <= 1e7);
    require(std::isfinite(map.yaw_rad));
    require(map.free_below >= 0.0 && map.free_below <= map.occupied_above);
    require(map.occupied_above <= 1.0);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text{reinterpret_cast<const char*>(data), size};
    try {
        check(parse_map_file(text, file));
    } catch (const LoadError& error) {
        require_faults_of(file, error);
    }
    return 0;
}
