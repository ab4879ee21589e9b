// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What least squares cannot tell: combinations of parameters that the residuals hardly depend on.
// Ceres' own covariance reports small deviations for parameters that are exactly degenerate, so the
// singular values of the Jacobian are looked at themselves. Pure; any thread.
#pragma once

#include <cstddef>
#include <vector>

namespace scipd::tools {

/// Row after row.
struct Jacobian {
    std::size_t columns = 0;
    std::vector<double> values;
};

/// For each parameter whether it is known. `jacobian`: of residuals whose deviation is 1, in
/// parameters that are scaled so that 1 is too large an error.
[[nodiscard]] std::vector<bool> known_parameters(const Jacobian& jacobian);

}  // namespace scipd::tools
