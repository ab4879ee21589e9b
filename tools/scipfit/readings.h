// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// All scans of one scanner in memory, one value a step, in the form that estimates need. Not the
// recording itself, which keeps more. Values; one thread.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/recording/values/scanner_identity.h"

namespace scipd::tools {

struct Readings {
    std::string files;  ///< where they are from, for comments
    sim::ScannerIdentity identity;
    std::size_t steps = 0;   ///< of each scan
    int first_step = 0;      ///< SCIP's number of the first one, or 0 if that is not known
    double first_rad = 0.0;  ///< where the first one looks
    double beam_rad = 0.0;   ///< from one to the next; 0: not known
    double period_s = 0.0;   ///< between scans; 0: not known
    bool has_codes = false;  ///< what stands where there is no distance is as it was sent
    bool has_intensities = false;
    bool whole_mm = false;    ///< all distances are whole millimetres
    std::size_t doubles = 0;  ///< scans that were left out, since they came twice
    /// Where each recording begins, in scans; and the end.
    std::vector<std::size_t> begins = {0};
    /// Scan after scan. A distance in mm; or none (see code_of).
    std::vector<float> mm;
    std::vector<float> intensity;  ///< as many, 0 where there is none; or empty

    [[nodiscard]] std::size_t scans() const { return steps == 0 ? 0 : mm.size() / steps; }
    [[nodiscard]] float at(std::size_t scan, std::size_t step) const {
        return mm[scan * steps + step];
    }
    [[nodiscard]] double angle_rad(std::size_t step) const {
        return first_rad + beam_rad * static_cast<double>(step);
    }
};

// What stands where there is no distance is negative: so no second table is needed.

inline constexpr float no_value = -1e9F;  ///< recordings in metres do not say which code it was

[[nodiscard]] inline bool is_distance(float mm) {
    return mm >= 0.0F;
}
[[nodiscard]] inline float as_code(float value) {
    return -1.0F - value;
}
/// Which code stands there, where recordings have codes.
[[nodiscard]] inline std::uint32_t code_of(float mm) {
    return static_cast<std::uint32_t>(std::lround(-1.0F - mm));
}

/// Makes codes of what is no distance that a scanner with these limits tells.
void apply_limits(double nearest_mm, double farthest_mm, Readings& readings);

}  // namespace scipd::tools
