// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Stands in for depth.cpp and depth_device.cpp in a build that found no headers to draw with.
#include <stdexcept>
#include <string>

#include "sim/backends/depth.h"
#include "sim/backends/depth_probe.h"

namespace scipd::sim {
namespace {

constexpr std::string_view what_is_missing =
    "not in this build: it found no libepoxy and EGL to build with (Debian's packages "
    "libepoxy-dev and libegl-dev)";

}  // namespace

std::string_view depth_description() {
    return what_is_missing;
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): depth.cpp keeps the scene
std::unique_ptr<RangeBackend> make_depth_backend(SharedScene, const DepthOptions&) {
    throw std::runtime_error("the depth backend is " + std::string(what_is_missing));
}

void prepare_drivers() {}

BackendProbe probe_depth() {
    return {"the depth backend is " + std::string(what_is_missing) + "\n", false};
}

}  // namespace scipd::sim
