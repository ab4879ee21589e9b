// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The world of a running scipd, fetched as its page fetches it. Values; one thread.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "sim/export/gltf_file.h"
#include "sim/export/placed_mesh.h"
#include "tools/control_client.h"

namespace scipd::tools {

struct DownloadedWorld {
    std::string name;
    std::vector<sim::PlacedMesh> meshes;  ///< where they are now, without the bodies of robots
    std::vector<glm::dvec2> robots_m;     ///< of robots with a sensor
    std::map<std::string, sim::ExportedLook> looks;  ///< by material
};

/// Throws ControlError.
DownloadedWorld download_world(ControlClient& client);

}  // namespace scipd::tools
