// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A product: how it speaks, what its optics are, and how well each of that is known. Data; no
// thread rule.
#pragma once

#include <string>
#include <string_view>

#include "protocol/device_profile.h"
#include "sim/sensor/sensor_spec.h"

namespace scipd::daemon {

/// How a figure is known.
enum class Evidence {
    seen,        ///< on the wire of a real unit
    measured,    ///< from recordings of this product
    documented,  ///< by its maker, or by a driver whose author had a unit
    deduced,     ///< from similar models, or made up if nothing is known
    assumed,     ///< to be as with the nearest relative, or of a usual size
};
[[nodiscard]] std::string_view name_of(Evidence evidence);

struct Sureness {
    Evidence texts = Evidence::deduced;  ///< what VV and II say
    Evidence range = Evidence::deduced;
    Evidence steps = Evidence::deduced;
    Evidence rate = Evidence::deduced;
    Evidence links = Evidence::deduced;
    Evidence commands = Evidence::deduced;
    Evidence codes = Evidence::deduced;  ///< what stands in place of a distance
    Evidence turn = Evidence::deduced;   ///< how long one really takes
    Evidence pace = Evidence::deduced;   ///< when replies and scans leave
    Evidence boot = Evidence::assumed;   ///< how long it takes, and waking up
    Evidence noise = Evidence::assumed;
    Evidence bias = Evidence::assumed;   ///< and drift
    Evidence light = Evidence::deduced;  ///< spot, wavelength, how dark a target it sees

    bool operator==(const Sureness&) const = default;
};

struct Model {
    protocol::DeviceProfile profile;
    sim::SensorSpec optics;
    Sureness sureness;
    /// A configuration gives its serial number, or its bias. Otherwise each unit has its own.
    bool own_serial = false;
    bool own_bias = false;

    bool operator==(const Model&) const = default;
};

/// Fills in what follows from what the device reports (PP): steps, period and range. The rest of
/// the optics stays.
Model make_model(const protocol::DeviceProfile& profile, sim::SensorSpec optics, Sureness sureness);

}  // namespace scipd::daemon
