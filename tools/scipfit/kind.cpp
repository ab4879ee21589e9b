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

bool holds(const ScanTable& readings, std::uint32_t code) {
    return std::ranges::find(readings.codes, static_cast<Code>(code)) != readings.codes.end();
}

/// For recordings that have no angles, such as arrays.
const Model* with_steps_and_codes(const ScanTable& readings) {
    const Model* found = nullptr;
    for (const Model& model : daemon::models()) {
        if (static_cast<std::size_t>(model.optics.beams()) != readings.beams) continue;
        if (holds(readings, model.profile.codes.nothing)) return &model;
        if (found == nullptr) found = &model;
    }
    return found;
}

const Model& nearest(const ScanTable& readings) {
    if (readings.beam_rad() == 0.0) {
        if (const Model* model = with_steps_and_codes(readings)) return *model;
    }
    return daemon::best_fit(
        daemon::recorded_lidar(readings.directions, readings.beams, readings.identity,
                               readings.period_s() > 0.0 ? 1.0 / readings.period_s() : 0.0));
}

}  // namespace

Kind kind_of(const ScanTable& readings, const std::string& named) {
    if (!named.empty()) {
        const auto model = daemon::model_named(named);
        if (!model) throw WrongInput(model.error().why);
        const auto same = [&](const Model& one) { return one.profile == model->profile; };
        return {&*std::ranges::find_if(daemon::models(), same), true, "as --model says"};
    }
    const std::string& says = readings.identity.model;
    if (const Model* model = daemon::model_named_in(says, readings.identity.firmware))
        return {model, true, "measured (the recording says " + sim::printable(says) + ")"};
    return {&nearest(readings), false,
            says.empty() ? "assumed (the recording does not say)"
                         : "assumed (the recording is of a " + sim::printable(says) +
                               ", and this is the nearest model)"};
}

void complete(const Model& model, ScanTable& readings) {
    const sim::SensorSpec& optics = model.optics;
    if (readings.beam_rad() == 0.0) {
        readings.directions = {.first_step = optics.first_step,
                               .first_rad = optics.angle_rad(optics.first_step),
                               .increment_rad = optics.beam_rad()};
    }
    const sim::ScannerIdentity& identity = readings.identity;
    const double nearest_mm = model.profile.nearest_mm;
    double farthest_mm = model.profile.dmax_mm;
    if (identity.max_range_m) farthest_mm = std::max(1.0, *identity.max_range_m * mm_per_m);
    readings.limit(std::max(nearest_mm, identity.min_range_m.value_or(0.0) * mm_per_m),
                   farthest_mm);
    if (!readings.has_codes) return;
    const protocol::DistanceCodes& sent = model.profile.codes;
    for (Code& code : readings.codes) {
        if (code == codes::nothing) code = static_cast<Code>(sent.nothing);
        if (code == codes::too_near) code = static_cast<Code>(sent.too_near);
        if (code == codes::too_far) code = static_cast<Code>(sent.too_far);
    }
}

}  // namespace scipd::tools
