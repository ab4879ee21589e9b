// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The last errors, which all ranges of a scan have: the drift of a unit that warms up, and the
// lattice that its ranges lie on. A small value, since compilers take several ranges at once only
// if they see that it stays as it is. Any thread.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>

#include "sim/sensor/sensor_spec.h"
#include "sim/time.h"

namespace scipd::sim {

class LastErrors {
  public:
    LastErrors(const SensorSpec& spec, Time on_for)
        : drift_m_(drift_m(spec.warm_up, on_for)),
          lattice_m_(spec.lattice_m >= finest_lattice_m ? spec.lattice_m : 0.0),
          per_lattice_(lattice_m_ > 0.0 ? 1.0 / lattice_m_ : 0.0) {}

    [[nodiscard]] float told_m(double range_m) const {
        // In this order what is no number becomes one.
        const double read_m = std::min(std::max(0.0, range_m + drift_m_), farthest_m);
        if (lattice_m_ == 0.0) return static_cast<float>(read_m);
        // A conversion is several times faster than std::round().
        const auto places = static_cast<std::int32_t>(read_m * per_lattice_ + 0.5);
        return static_cast<float>(places * lattice_m_);
    }

  private:
    /// No scanner tells more, nor finer. So a place on a lattice is an int.
    static constexpr double farthest_m = 20'000.0;
    static constexpr double finest_lattice_m = 1e-5;

    [[nodiscard]] static double drift_m(const WarmUp& warm_up, Time on_for) {
        if (warm_up.drift_m == 0.0) return 0.0;
        const std::chrono::duration<double> on_for_s = on_for;
        const std::chrono::duration<double> constant_s = warm_up.time_constant;
        return warm_up.drift_m * std::exp(-on_for_s / constant_s);
    }

    double drift_m_;
    double lattice_m_;
    double per_lattice_;
};

}  // namespace scipd::sim
