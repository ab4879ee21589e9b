// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What is known of the light of faces whose ranges and angles are known: how bright each surface
// is, by the receiver's gain, and how that falls with the angle of incidence. Values; one thread.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tools/scipfit/calibration.h"

namespace scipd::tools {

/// The product of a surface's reflectance and the receiver's gain: its intensity, met head-on at
/// FaceLight::reference_mm.
struct SurfaceLight {
    std::size_t surface = 0;
    std::string name = {};
    std::size_t beams = 0;
    std::optional<Interval> intensity;
};

/// The share of the light that a face sends back which is met at this angle, beside head-on.
struct IncidenceAt {
    double incidence_rad = 0.0;
    Interval share;
};

/// How many times as bright a face is at this range as at FaceLight::reference_mm.
struct RangeLight {
    double range_mm = 0.0;
    double times = 0.0;
};

struct FaceLight {
    double reference_mm = 0.0;
    std::vector<RangeLight> by_range;
    std::vector<SurfaceLight> surfaces;  ///< by growing surface
    std::vector<IncidenceAt> incidence;  ///< those that are known
    Unknowns unknown;
};

/// Intensities are taken as the product of what the surface, the range and the angle make of them.
/// Nothing where the sights have none.
[[nodiscard]] std::optional<FaceLight> light_of_faces(const Calibration& calibration);

}  // namespace scipd::tools
