// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The normal equations of a PlaceFit. Values; one thread.
#pragma once

#include "tools/scipfit/place_rows.h"
#include <Eigen/Dense>

namespace scipd::tools {

/// The normal equations of some rows.
struct PlaceEquations {
    explicit PlaceEquations(const PlaceFit& fit);

    /// `off`: in place of the row's own.
    void add(const PlaceRow& row, double times, double off);
    /// The fit that they lead to.
    [[nodiscard]] PlaceFit solved(PlaceFit fit) const;

    Eigen::MatrixXd matrix;
    Eigen::VectorXd right;
};

}  // namespace scipd::tools
