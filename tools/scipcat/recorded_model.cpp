// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/recorded_model.h"

#include <cstddef>

#include "daemon/models/model_registry.h"
#include "tools/options.h"

namespace scipd::tools {
namespace {

template <class Value>
void fill(std::optional<Value>& known, Value value) {
    if (!known) known = value;
}

void fill(sim::ScannerIdentity& identity, const protocol::DeviceProfile& profile) {
    constexpr double m_per_mm = 1e-3;
    if (identity.model.empty()) identity.model = profile.name.substr(0, profile.name.find('@'));
    fill(identity.min_range_m, profile.dmin_mm * m_per_mm);
    fill(identity.max_range_m, profile.dmax_mm * m_per_mm);
    fill(identity.steps_per_turn, profile.ares);
    fill(identity.front_step, profile.afrt);
}

}  // namespace

void take_for_model(PlotSubject& subject, const std::string& name) {
    const auto model = daemon::model_named(name);
    if (!model) throw WrongInput("--model: " + model.error().why);
    const protocol::DeviceProfile& profile = model->profile;
    fill(subject.identity, profile);
    sim::Directions& directions = subject.scan.directions;
    if (directions.first_rad && directions.increment_rad) return;
    const auto steps = static_cast<std::size_t>(profile.amax - profile.amin + 1);
    if (!directions.first_step && subject.scan.steps() != steps)
        throw WrongInput("the scan does not say where its " + std::to_string(subject.scan.steps()) +
                         " values look, and " + name + " has " + std::to_string(steps) +
                         " steps; name the model that it was recorded from");
    if (!directions.first_step) directions.first_step = profile.amin;
    directions = sim::with_angles(directions, subject.identity);
}

}  // namespace scipd::tools
