// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How rays meet the world. A backend is made for one scene and lives on one thread at a time. The
// public functions check what they are given and then call the private virtual ones, so that no
// backend can forget a check.
#pragma once

#include <span>
#include <vector>

#include <glm/vec3.hpp>

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
    /// as many as the directions need, that the unseen model is movable, and that every object that
    /// is met exists.
    void cast(const Fan& fan, std::span<Hit> hits);

    /// Whether it tells the normals of faces, and casts fans whose rays begin anywhere: both are
    /// needed to follow light behind glass and into mirrors.
    [[nodiscard]] virtual bool follows_light() const { return false; }
    /// Casts, and tells the unit normal in W of each face that is met, to either side. Only for
    /// backends that follow light.
    void cast(const Fan& fan, std::span<Hit> hits, std::span<glm::vec3> world_normals);

    /// Whether it can cast what stands still first and what moves later, and leaves out all movable
    /// models that a fan cannot meet.
    [[nodiscard]] virtual bool casts_apart() const { return false; }
    /// Replaces the hits in front of which a movable model stands that the fan can meet. The hits
    /// are those of an earlier cast. Only for backends that cast apart.
    void cast_moving(const Fan& fan, std::span<Hit> hits);

    /// Whether it is bound to the thread that casts, until leave_thread().
    [[nodiscard]] virtual bool binds_thread() const { return false; }
    /// Releases the calling thread: another one may use or destroy the backend next.
    virtual void leave_thread() {}

  private:
    virtual void do_move(ModelId model, const Pose& world_from_model) = 0;
    virtual void do_cast(const Fan& fan, std::span<Hit> hits) = 0;
    virtual void do_cast_with_normals(const Fan& fan, std::span<Hit> hits,
                                      std::span<glm::vec3> world_normals);
    virtual void do_cast_moving(const Fan& fan, std::span<Hit> hits);
    void check(const Fan& fan, std::span<const Hit> hits) const;
    void check_met(std::span<const Hit> hits) const;

    SharedScene scene_;
    std::vector<Pose> placed_;  ///< by ModelId
};

}  // namespace scipd::sim
