// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/range_backend.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace scipd::sim {

RangeBackend::RangeBackend(SharedScene scene) : scene_(std::move(scene)) {
    assert(scene_);
    for (const Model& model : scene_->models)
        placed_.push_back(model.world_from_model);
}

void RangeBackend::move(ModelId model, const Pose& world_from_model) {
    assert(model < scene_->models.size() && scene_->models[model].movable);
    if (placed_[model] == world_from_model) return;
    placed_[model] = world_from_model;
    do_move(model, world_from_model);
}

void RangeBackend::cast(const Fan& fan, std::span<Hit> hits) {
    check(fan, hits);
    do_cast(fan, hits);
    check_met(hits);
}

void RangeBackend::cast(const Fan& fan, std::span<Hit> hits, std::span<glm::vec3> world_normals) {
    check(fan, hits);
    assert(world_normals.size() == hits.size());
    do_cast_with_normals(fan, hits, world_normals);
    check_met(hits);
}

void RangeBackend::cast_moving(const Fan& fan, std::span<Hit> hits) {
    check(fan, hits);
    assert(fan.can_meet);
    do_cast_moving(fan, hits);
    check_met(hits);
}

void RangeBackend::do_cast_moving(const Fan&, std::span<Hit>) {
    assert(false && "this backend casts all at once: ask casts_apart() first");
}

void RangeBackend::do_cast_with_normals(const Fan&, std::span<Hit>, std::span<glm::vec3>) {
    assert(false && "this backend tells no normals: ask follows_light() first");
}

void RangeBackend::check([[maybe_unused]] const Fan& fan,
                         [[maybe_unused]] std::span<const Hit> hits) const {
    assert(hits.size() == fan.directions.size());
    assert(fan.world_from_sensor.size() == 1 ||
           fan.world_from_sensor.size() * fan.directions_per_pose == fan.directions.size());
    assert(fan.max_range_m >= 0.0F);
    [[maybe_unused]] const ModelId unseen = fan.unseen.model;
    assert(unseen == no_model ||
           (unseen < scene_->models.size() && scene_->models[unseen].movable));
}

void RangeBackend::check_met([[maybe_unused]] std::span<const Hit> hits) const {
    assert(std::ranges::all_of(hits, [&objects = scene_->objects](const Hit& hit) {
        return !hit.met() || hit.object < objects.size();
    }));
}

}  // namespace scipd::sim
