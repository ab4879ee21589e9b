// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Says of a sensor that it is where nobody can want it: inside something solid, or below the
// ground. Looks when a sensor first casts into a scene, and when it has jumped; on the loader's
// thread, for it takes a while. Lives on the I/O thread.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "daemon/world/loader.h"
#include "daemon/world/world.h"

namespace scipd::daemon {

class PlaceWatch {
  public:
    /// What `world` is told that sensors see, it is told. Both must outlive it.
    PlaceWatch(World& world, Loader& loader);

    /// What is wrong with the place of this sensor; nothing, as far as anybody has looked.
    [[nodiscard]] std::optional<std::string> warning(const std::string& sensor) const;

  private:
    /// Of one sensor.
    struct Look {
        std::weak_ptr<const sim::Scene> scene;
        glm::dvec3 at_m{0.0};
        std::string warning;  ///< empty: nothing is wrong
        std::string told;     ///< in the log
    };
    struct Question {
        std::string robot;
        std::string sensor;
        std::weak_ptr<const sim::Scene> scene;
        glm::dvec3 at_m;
        /// The only object that its beams meet, and close; nothing: there are others.
        std::optional<sim::ObjectId> all_around;
        sim::ModelId body;
    };

    void see(const Cast& cast);
    Loader::Work answer();
    void take(const std::string& sensor, const std::string& warning);

    World& world_;
    Loader& loader_;
    std::map<std::string, Look> looks_;
    std::vector<Question> waiting_;
    sim::Time latest_{};
};

}  // namespace scipd::daemon
