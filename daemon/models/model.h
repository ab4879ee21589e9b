// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A product: what it is on the wire, what its optics are, and how sure that is. Data; no thread
// rule.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "protocol/device_profile.h"
#include "sim/sensor/sensor_spec.h"

namespace scipd::daemon {

/// How a figure is known.
enum class Evidence {
    seen,        ///< on the wire of a real unit
    documented,  ///< by its maker, or by a driver whose author had a unit
    deduced,     ///< from kindred models, or made up where nothing is known
};
[[nodiscard]] std::string_view name_of(Evidence evidence);

struct Sureness {
    Evidence texts = Evidence::deduced;  ///< what VV and II say
    Evidence range = Evidence::deduced;
    Evidence steps = Evidence::deduced;
    Evidence rate = Evidence::deduced;
    Evidence links = Evidence::deduced;
    Evidence commands = Evidence::deduced;
    Evidence noise = Evidence::deduced;

    bool operator==(const Sureness&) const = default;
};

struct Model {
    protocol::DeviceProfile profile;
    sim::SensorSpec optics;
    Sureness sureness;

    bool operator==(const Model&) const = default;
};

/// The optics follow from what the device says of itself (PP) but for how well it sees.
Model make_model(const protocol::DeviceProfile& profile, std::vector<sim::NoiseStep> noise,
                 Sureness sureness);

/// One line: the name; range, steps, rate, links and commands, each with how sure that is; how sure
/// texts and noise are.
[[nodiscard]] std::string describe(const Model& model);

}  // namespace scipd::daemon
