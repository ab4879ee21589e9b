// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Which poses of models matter to a daemon: those near its robots. A model that leaves is seen to
// leave, and one that stands still far away is there when a robot comes. Values; one thread.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <unordered_set>
#include <vector>

#include <glm/vec3.hpp>

#include "sim/loaders/poses/pose_line.h"

namespace scipd::daemon {

class Nearness {
  public:
    /// Nothing nearer than this, in the plane, is left out.
    explicit Nearness(double near_m);

    /// The robots are there now. Returns the poses of models that were left out and matter now.
    [[nodiscard]] std::vector<sim::PoseLine> look_around(const std::vector<glm::dvec3>& robots_m);

    /// Whether a pose of a model matters. If not, it may do later.
    [[nodiscard]] bool matters(const sim::PoseLine& line);

    /// How many models are left out at present.
    [[nodiscard]] std::size_t far() const { return far_.size(); }

  private:
    using Cell = std::uint64_t;

    [[nodiscard]] Cell cell_at(double x_m, double y_m) const;
    [[nodiscard]] bool is_near(const glm::dvec3& at_m) const;

    double size_m_;                             ///< of a cell
    std::unordered_set<Cell> near_;             ///< those of robots, and all around them
    std::map<std::string, sim::PoseLine> far_;  ///< the latest poses, by model
};

}  // namespace scipd::daemon
