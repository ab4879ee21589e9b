// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where scanners stand, and what they read too far, by least squares over all that they see: a
// reading is the range of the face that it looks at, and the bias at that range. Faces are known,
// or fitted too. Values; one thread.
#pragma once

#include <vector>

#include "tools/scipfit/bias_curve.h"
#include "tools/scipfit/sight.h"

namespace scipd::tools {

/// How far off a place may be that somebody has measured; endless: nobody has.
struct PlaceError {
    double mm = 0.0;
    double yaw_rad = 0.0;
};

struct PlaceFit {
    std::vector<FlatPose> places;
    std::vector<FaceLine> faces;
    std::vector<double> knots_mm;
    std::vector<double> bias_mm;  ///< at the knots
    double spread_mm = 0.0;       ///< of the readings around all that, beyond noise
    bool fits_faces = false;
    std::vector<FlatPose> given;     ///< places as they were measured...
    std::vector<PlaceError> errors;  ///< ...and how well
};

/// Refines places, curve and, where it fits them, faces.
void refine(const std::vector<Sight>& sights, PlaceFit& fit);

/// How far a reading is off what the fit says of it.
[[nodiscard]] double off_mm(const Sight& sight, const PlaceFit& fit);

}  // namespace scipd::tools
