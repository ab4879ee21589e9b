// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Warns of sensors that stand inside something solid or below the ground, where nobody can want
// them. It looks when a sensor first casts into a scene and whenever the sensor has jumped. Looking
// takes a while, so it is done on the worker's thread. Lives on the I/O thread.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "daemon/world/worker.h"
#include "daemon/world/world.h"

namespace scipd::daemon {

class PlaceWatch {
  public:
    /// Listens to the casts of `world`. Both must outlive it.
    PlaceWatch(World& world, Worker& worker);

    /// What is wrong with the place of this sensor; nothing where no fault has been found.
    [[nodiscard]] std::optional<std::string> warning(const std::string& sensor) const;

  private:
    /// Of one sensor.
    struct Look {
        std::weak_ptr<const sim::Scene> scene;
        glm::dvec3 at_m{0.0};
        std::string warning;  ///< empty: nothing is wrong
        std::string told;     ///< the last warning that was logged
    };
    struct Question {
        std::string robot;
        std::string sensor;
        std::weak_ptr<const sim::Scene> scene;
        glm::dvec3 at_m;
        /// The object that all beams meet close by; nothing where they meet several or none.
        std::optional<sim::ObjectId> all_around;
        sim::ModelId body;
    };

    void see(const Cast& cast);
    Worker::Work answer();
    void take(const std::string& sensor, const std::string& warning);

    World& world_;
    Worker& worker_;
    std::map<std::string, Look> looks_;
    std::vector<Question> waiting_;
    sim::Time latest_{};
};

}  // namespace scipd::daemon
