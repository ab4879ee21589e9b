// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Warns of sensors that stand inside something solid or below the ground, where nobody can want
// them. It looks when a sensor first casts into a scene and whenever the sensor has jumped. Looking
// takes a while, so it is done on the worker's thread. PlaceGlance lives where its sensors do,
// PlaceWatch on the I/O thread.
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

/// Where a sensor stands anew.
struct NewPlace {
    std::string robot;
    std::string sensor;
    std::weak_ptr<const sim::Scene> scene;
    glm::dvec3 at_m;
    sim::Time time;
    /// The object that all beams meet close by; nothing where they meet several or none.
    std::optional<sim::ObjectId> all_around;
    sim::ModelId body;
    std::vector<sim::ObjectId> housing;  ///< of the sensor
};

/// Notices new places of the sensors that cast into one world.
class PlaceGlance {
  public:
    using Tell = std::function<void(NewPlace)>;

    /// Listens to the casts of `world`, which must outlive it.
    PlaceGlance(World& world, Tell tell);
    PlaceGlance(const PlaceGlance&) = delete;
    PlaceGlance& operator=(const PlaceGlance&) = delete;

  private:
    struct Seen {
        std::weak_ptr<const sim::Scene> scene;
        glm::dvec3 at_m{0.0};
    };

    void see(const Cast& cast);

    World& world_;
    Tell tell_;
    std::map<std::string, Seen> seen_;
};

class PlaceWatch {
  public:
    /// Both must outlive it.
    PlaceWatch(const World& world, Worker& worker) : world_(world), worker_(worker) {}

    void look_at(NewPlace place);
    /// What is wrong with the place of this sensor; nothing where no fault has been found.
    [[nodiscard]] std::optional<std::string> warning(const std::string& sensor) const;

  private:
    /// What one sensor was warned of.
    struct Look {
        std::string warning;  ///< empty: nothing is wrong
        std::string told;     ///< the last warning that was logged
    };

    Worker::Work answer();
    void take(const std::string& sensor, const std::string& warning);

    const World& world_;
    Worker& worker_;
    std::map<std::string, Look> looks_;
    std::vector<NewPlace> waiting_;
};

}  // namespace scipd::daemon
