// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The world as a page draws it: what is there, and where all of it is now. A value; any thread.
#pragma once

#include <string>
#include <vector>

#include "sim/time.h"
#include "sim/world/material_library.h"
#include "sim/world/pose.h"
#include "sim/world/scene.h"

namespace scipd::daemon {

struct RobotView {
    std::string name;
    sim::Pose pose;
    sim::ModelId body = sim::no_model;
};

struct WorldView {
    /// Another one whenever there are other objects, materials or robots.
    std::string version;
    /// Another one whenever a world is loaded; edits leave it as it is.
    std::string loaded;
    int most_body_bytes = 0;  ///< that a request may have which adds a model
    sim::SharedScene scene;
    sim::SharedMaterials materials;
    sim::Time time{};
    std::vector<sim::Pose> models;  ///< by ModelId
    std::vector<RobotView> robots;
};

}  // namespace scipd::daemon
