// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What one page knows of where things are, so that it is told only of what has moved since. Lives
// on the I/O thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "daemon/api/world_view.h"

namespace scipd::daemon {

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
