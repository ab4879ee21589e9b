// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where the values of a scan look: in the steps of SCIP, and in angles. A value; any thread.
#pragma once

#include <optional>

#include "sim/recording/values/scanner_identity.h"

namespace scipd::sim {

/// What the recording does not say is empty.
struct Directions {
    std::optional<int> first_step;        ///< SCIP's number of the step that the first value is of
    int cluster = 1;                      ///< neighbouring steps that share one value
    std::optional<double> first_rad;      ///< counter-clockwise from forward
    std::optional<double> increment_rad;  ///< from one value to the next

    bool operator==(const Directions&) const = default;
};

/// With the angles that follow from the steps, if the scanner says which step looks forward and how
/// many there are in a turn.
[[nodiscard]] Directions with_angles(Directions directions, const ScannerIdentity& identity);

/// The reverse: what steps and angles together say of the scanner's turn.
void learn_turn(const Directions& directions, ScannerIdentity& identity);

}  // namespace scipd::sim
