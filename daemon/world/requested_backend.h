// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The backend that a sensor asks for, and the fans for which `auto` looks for the fastest one. A
// value; any thread.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "daemon/world/backend_choice.h"
#include "sim/backends/depth_options.h"
#include "sim/world/material_library.h"
#include "sim/world/pose.h"

namespace scipd::daemon {

struct RequestedBackend {
    std::string sensor;                  ///< "rescue/front"
    std::size_t shard = 0;               ///< that it lives on
    std::optional<std::string> backend;  ///< its name; nothing: `auto`
    sim::DepthOptions depth;
    // What `auto` is measured with.
    std::vector<glm::vec3> directions;
    int poses = 1;  ///< per sweep, while the sensor moves
    sim::Pose world_from_sensor;
    float max_range_m = 0.0F;
    /// What is known of materials, for a sensor that sees light of this wavelength; else null.
    sim::SharedMaterials materials;
    int wavelength_nm = 0;
    /// What `auto` takes by now; null: nothing yet, so the preferred backend.
    SharedChoice settled;
};

/// Whether what is measured for one holds for the other. Where they are in the world can make one
/// backend somewhat faster or slower, but hardly the slower one the faster.
[[nodiscard]] inline bool ask_alike(const RequestedBackend& a, const RequestedBackend& b) {
    return a.depth == b.depth && a.poses == b.poses && a.max_range_m == b.max_range_m &&
           a.directions == b.directions;
}

}  // namespace scipd::daemon
