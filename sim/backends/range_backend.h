// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How rays meet the world. A backend is made for one scene and lives on one thread at a time. The
// public functions check what they are given and then call the private virtual ones, so that no
// backend can forget a check.
#pragma once

#include <span>
#include <vector>

#include "sim/backends/fan.h"
#include "sim/world/scene.h"

namespace scipd::sim {

class RangeBackend {
  public:
    explicit RangeBackend(SharedScene scene);
    RangeBackend(const RangeBackend&) = delete;
    RangeBackend& operator=(const RangeBackend&) = delete;
    virtual ~RangeBackend() = default;

    [[nodiscard]] const Scene& scene() const { return *scene_; }

    /// Places a movable model elsewhere, from the next cast on. Asserts that the model exists and
    /// is movable. Costs nothing where it is there already.
    void move(ModelId model, const Pose& world_from_model);

    /// Fills hits[i] for fan.directions[i]. Asserts that the sizes agree, that there is one pose or
    /// one per ray, that the unseen model is movable, and that every object that is met exists.
    void cast(const Fan& fan, std::span<Hit> hits);

    /// Releases the calling thread: another one may use or destroy the backend next.
    virtual void leave_thread() {}

  private:
    virtual void do_move(ModelId model, const Pose& world_from_model) = 0;
    virtual void do_cast(const Fan& fan, std::span<Hit> hits) = 0;

    SharedScene scene_;
    std::vector<Pose> placed_;  ///< by ModelId
};

}  // namespace scipd::sim
