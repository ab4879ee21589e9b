// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A piece of a recording beside the same piece of scipd's own noise as it was fitted: how far each
// reading lies from its beam's trend. Values; one thread.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "tools/scipfit/fit.h"

namespace scipd::tools {

/// Neighbouring beams of one face, scan after scan.
struct NoisePiece {
    int first_step = 0;
    std::size_t beams = 0;
    std::size_t scans = 0;
    std::vector<double> real_mm;       ///< NaN where there was no distance
    std::vector<double> simulated_mm;  ///< as many
};

/// The longest face of the longest station, or nothing where it has few beams.
[[nodiscard]] std::optional<NoisePiece> noise_piece(const Standing& standing, const Fit& fit);

}  // namespace scipd::tools
