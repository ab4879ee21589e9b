// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The world as a page draws it: its objects and their present poses; and the poses that one page
// knows, so that only motion is sent. Values; a WorldMotion lives on the I/O thread.
#pragma once

#include <optional>
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

/// The poses that one page knows.
class WorldMotion {
  public:
    /// {"scene": version} where that is not the one it was told of last: what is there is another
    /// one, and all that can move counts as moved.
    std::optional<std::string> news(const WorldView& now);
    /// {"time_s", "robots": {NAME: {"xyz","q"}}, "models": {..}} of all that has moved since it was
    /// told last; nothing has, nothing is told.
    std::optional<std::string> moved(const WorldView& now);

  private:
    std::string version_;
    std::vector<std::optional<sim::Pose>> models_;  ///< as told, by ModelId
    std::vector<std::optional<sim::Pose>> robots_;
};

}  // namespace scipd::daemon
