// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/world/movers.h"

#include <cstddef>

namespace scipd::daemon {
namespace {

// What goes on after its last pose may be anywhere.
Whereabouts whereabouts_of(const MovableModel& model) {
    using After = sim::PosePolicy::After;
    const bool goes_on =
        model.carrier != nullptr && model.carrier->start.policy.after == After::extrapolate;
    if (model.follows_script() || goes_on) return {};
    const sim::PoseTrack& path = model.path();
    return {{path.last().translation_m, model.radius_m}, path.last_time()};
}

sim::Mover mover_of(MovableModel& model, sim::Time from, sim::Time to) {
    if (model.follows_script()) model.track = model.script->between(model.begun, from, to);
    return {model.id, model.radius_m, &model.path()};
}

}  // namespace

void Movers::view(Models& models) {
    models_.clear();
    whereabouts_.clear();
    for (auto& [name, model] : models) {
        model.place = models_.size();
        models_.push_back(&model);
        whereabouts_.push_back(whereabouts_of(model));
    }
}

void Movers::leaves_script(const MovableModel& model) {
    whereabouts_[model.place] = whereabouts_of(model);
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
