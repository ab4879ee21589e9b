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
    assert(hits.size() == fan.directions.size());
    assert(fan.world_from_sensor.size() == 1 ||
           fan.world_from_sensor.size() == fan.directions.size());
    assert(fan.max_range_m >= 0.0F);
    assert(fan.unseen == no_model ||
           (fan.unseen < scene_->models.size() && scene_->models[fan.unseen].movable));
    do_cast(fan, hits);
    assert(std::ranges::all_of(hits, [&objects = scene_->objects](const Hit& hit) {
        return !hit.met() || hit.object < objects.size();
    }));
}

}  // namespace scipd::sim
