// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Everything that recordings tell of the scanner that made them, and what they do not. Values; one
// thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/scipfit/calibration.h"
#include "tools/scipfit/code_places.h"
#include "tools/scipfit/edge_fit.h"
#include "tools/scipfit/face_light.h"
#include "tools/scipfit/held_out.h"
#include "tools/scipfit/kind.h"
#include "tools/scipfit/known_length.h"
#include "tools/scipfit/lattice.h"
#include "tools/scipfit/light_fit.h"
#include "tools/scipfit/noise_fit.h"
#include "tools/scipfit/smoothing_fit.h"

namespace scipd::tools {

struct Fit {
    Kind kind;
    std::string files;
    std::size_t scans = 0;  ///< that stand still
    std::size_t all_scans = 0;
    std::size_t beams = 0;  ///< that see a smooth face, over all stations
    std::size_t stations = 0;
    std::size_t doubles = 0;
    std::optional<SmoothingFit> smoothing;
    Lattice lattice;
    std::optional<NoiseFit> noise;
    std::optional<HeldOut> held_out;
    CodeShares codes;
    LostBeams lost;
    LightFit light;
    std::optional<MixedBeams> mixed;
    std::optional<Drift> drift;
    std::vector<BiasAt> bias;
    std::optional<Calibration> calibration;
    std::optional<FaceLight> face_light;
    Unknowns unknown;
};

/// The parts of a recording that estimates need. The readings must be complete (kind.h), and
/// outlive it.
[[nodiscard]] Standing look_at(const ScanTable& readings);

/// What somebody has measured beside the recordings.
struct Given {
    std::vector<Length> lengths = {};
    KnownWorld* world = nullptr;
    std::vector<FlatPose> places = {};  ///< in that world, by station
};

/// Throws WrongInput where a length cannot be, or a world does not look so.
[[nodiscard]] Fit fit_scanner(const Standing& standing, const Kind& kind, const Given& given);

}  // namespace scipd::tools
