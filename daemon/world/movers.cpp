// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/world/movers.h"

#include <chrono>
#include <cstddef>

#include <glm/geometric.hpp>

namespace scipd::daemon {
namespace {

Whereabouts whereabouts_of(const MovableModel& model, double goes_on_m) {
    if (model.follows_script()) return {};
    const sim::PoseTrack& path = model.path();
    return {{path.last().translation_m, model.radius_m + goes_on_m}, path.last_time()};
}

sim::Mover mover_of(MovableModel& model, sim::Time from, sim::Time to) {
    if (model.follows_script()) model.track = model.script->between(model.begun, from, to);
    return {model.id, model.radius_m, &model.path()};
}

}  // namespace

double Movers::goes_on_m(const MovableModel& model) {
    if (model.follows_script()) return 0.0;
    const sim::PoseTrack::Stretch last = model.path().stretch(model.path().last_time());
    const double speed_mps = glm::length(last.velocity.linear_mps);
    if (speed_mps == 0.0) return 0.0;
    return speed_mps * std::chrono::duration<double>(last.end - last.begin).count();
}

void Movers::view(Models& models) {
    models_.clear();
    whereabouts_.clear();
    for (auto& [name, model] : models) {
        model.place = models_.size();
        models_.push_back(&model);
        whereabouts_.push_back(whereabouts_of(model, goes_on_m(model)));
    }
}

void Movers::leaves_script(const MovableModel& model) {
    whereabouts_[model.place] = whereabouts_of(model, goes_on_m(model));
}

std::vector<sim::Mover> Movers::all(sim::Time from, sim::Time to, sim::ModelId except) const {
    std::vector<sim::Mover> movers;
    movers.reserve(models_.size());
    for (MovableModel* const model : models_) {
        if (model->id != except) movers.push_back(mover_of(*model, from, to));
    }
    return movers;
}

std::vector<sim::Mover> Movers::within(const Ball& ball, sim::Time from, sim::Time to,
                                       sim::ModelId except) const {
    std::vector<sim::Mover> movers;
    for (std::size_t i = 0; i < models_.size(); ++i) {
        if (whereabouts_[i].is_outside(ball, from) || models_[i]->id == except) continue;
        movers.push_back(mover_of(*models_[i], from, to));
    }
    return movers;
}

}  // namespace scipd::daemon
