// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/kind.h"

#include <algorithm>
#include <cmath>

#include "daemon/models/best_fit.h"
#include "daemon/models/model_registry.h"
#include "sim/text/quote.h"
#include "tools/options.h"

namespace scipd::tools {
namespace {

using daemon::Model;

constexpr double mm_per_m = 1000.0;

/// UTM-30LX says "UTM-30LX(Hokuyo Automatic Co.,Ltd.)" of itself. Of several firmwares the one of
/// the recording, else the first.
const Model* said_by(const sim::ScannerIdentity& identity) {
    const Model* found = nullptr;
    for (const Model& model : daemon::models()) {
        const bool same = identity.model == model.profile.model ||
                          identity.model == model.profile.name ||
                          identity.model.starts_with(model.profile.name + "(");
        if (!same) continue;
        if (identity.firmware == model.profile.firmware) return &model;
        if (found == nullptr) found = &model;
    }
    return found;
}

bool holds(const Readings& readings, std::uint32_t value) {
    return std::ranges::find(readings.mm, static_cast<float>(value)) != readings.mm.end();
}

/// For recordings that have no angles, such as arrays.
const Model* with_steps_and_codes(const Readings& readings) {
    const Model* found = nullptr;
    for (const Model& model : daemon::models()) {
        if (static_cast<std::size_t>(model.optics.beams()) != readings.steps) continue;
        if (readings.has_codes && holds(readings, model.profile.codes.nothing)) return &model;
        if (found == nullptr) found = &model;
    }
    return found;
}

const Model& nearest(const Readings& readings) {
    if (readings.beam_rad == 0.0) {
        if (const Model* model = with_steps_and_codes(readings)) return *model;
    }
    return daemon::best_fit({.samples = static_cast<int>(readings.steps),
                             .min_angle_rad = readings.first_rad,
                             .max_angle_rad = readings.angle_rad(readings.steps - 1),
                             .min_range_m = readings.identity.min_range_m.value_or(0.0),
                             .max_range_m = readings.identity.max_range_m.value_or(0.0),
                             .rate_hz = readings.period_s > 0.0 ? 1.0 / readings.period_s : 0.0});
}

}  // namespace

Kind kind_of(const Readings& readings, const std::string& named) {
    if (!named.empty()) {
        const auto model = daemon::model_named(named);
        if (!model) throw WrongInput(model.error().why);
        const auto same = [&](const Model& one) { return one.profile == model->profile; };
        return {&*std::ranges::find_if(daemon::models(), same), true, "as --model says"};
    }
    const std::string& says = readings.identity.model;
    if (const Model* model = said_by(readings.identity); model != nullptr && !says.empty())
        return {model, true, "measured (the recording says " + sim::printable(says) + ")"};
    return {&nearest(readings), false,
            says.empty() ? "assumed (the recording does not say)"
                         : "assumed (the recording is of a " + sim::printable(says) +
                               ", and this is the nearest model)"};
}

void complete(const Model& model, Readings& readings) {
    const sim::SensorSpec& optics = model.optics;
    if (readings.beam_rad == 0.0) {
        readings.beam_rad = optics.beam_rad();
        readings.first_rad = optics.angle_rad(optics.first_step);
        readings.first_step = optics.first_step;
    }
    const sim::ScannerIdentity& identity = readings.identity;
    const double nearest_mm = model.profile.nearest_mm;
    double farthest_mm = model.profile.dmax_mm;
    if (identity.max_range_m) farthest_mm = std::max(1.0, *identity.max_range_m * mm_per_m);
    apply_limits(std::max(nearest_mm, identity.min_range_m.value_or(0.0) * mm_per_m), farthest_mm,
                 readings);
}

}  // namespace scipd::tools
