// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Which backend casts for which sensor, in one scene. Sensors that want the same share one. Made on
// any thread (BackendWorkshop), used on one at a time.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "sim/backends/depth_options.h"
#include "sim/backends/range_backend.h"
#include "sim/time.h"

namespace scipd::daemon {

/// What casts for a sensor, and for how long that has been settled.
struct BackendChoice {
    std::string backend;  ///< "embree", "depth" or "reference"
    std::string reason;   ///< what "auto" was settled by; empty: it was not "auto"
    /// Of the scene that it was measured in; nothing: it was not measured.
    std::optional<std::size_t> faces;
};

using SharedChoice = std::shared_ptr<const BackendChoice>;

/// What a sensor asks for.
struct BackendWish {
    std::string sensor;   ///< "rescue/front"
    std::string backend;  ///< as configured: "auto", ..
    sim::DepthOptions depth;
    /// What "auto" is measured with.
    std::vector<glm::vec3> directions;
    int poses = 1;  ///< per sweep, while it moves
    sim::Pose world_from_sensor;
    float max_range_m = 0.0F;
    /// What "auto" has been settled by; null: nothing yet, so rays.
    SharedChoice settled;
};

class SensorBackends {
  public:
    void assign(const std::string& sensor, std::shared_ptr<sim::RangeBackend> backend,
                SharedChoice choice);

    // Of a sensor that a backend was assigned to.
    [[nodiscard]] sim::RangeBackend& of(std::string_view sensor) const {
        return *sensors_.find(sensor)->second.backend;
    }
    [[nodiscard]] const SharedChoice& choice_of(std::string_view sensor) const {
        return sensors_.find(sensor)->second.choice;
    }

    /// What "auto" takes now that it was measured again, as these take the place of those.
    void log_changes_since(const SensorBackends& before) const;

    /// As RangeBackend has it.
    void leave_thread();

  private:
    struct Assigned {
        std::shared_ptr<sim::RangeBackend> backend;
        SharedChoice choice;
    };

    std::vector<sim::RangeBackend*> backends_;  ///< each once
    std::map<std::string, Assigned, std::less<>> sensors_;
};

/// Bound to no thread when this returns. Measures nothing: "auto" is what it has been settled as.
/// Throws std::runtime_error where something that was asked for by name cannot be had on this
/// machine; "auto" is content with rays.
SensorBackends make_backends(std::span<const BackendWish> wishes, const sim::SharedScene& scene);

/// Rays, unmeasured: where two runs have to be the same, and until there is time to measure.
SharedChoice rays_unmeasured(std::string why);

}  // namespace scipd::daemon
