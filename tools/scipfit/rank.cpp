// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/rank.h"

#include <algorithm>

#include <Eigen/Dense>

namespace scipd::tools {

std::vector<bool> known_parameters(const Jacobian& jacobian) {
    const auto columns = static_cast<Eigen::Index>(jacobian.columns);
    std::vector<bool> known(jacobian.columns, false);
    if (columns == 0 || jacobian.values.empty()) return known;
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Eigen::Map<const Rows> rows(jacobian.values.data(),
                                      static_cast<Eigen::Index>(jacobian.values.size()) / columns,
                                      columns);
    // The singular values of R are those of the whole matrix, which may have many rows.
    Eigen::MatrixXd padded = Eigen::MatrixXd::Zero(std::max(rows.rows(), columns), columns);
    padded.topRows(rows.rows()) = rows;
    const Eigen::MatrixXd r =
        padded.householderQr().matrixQR().topRows(columns).triangularView<Eigen::Upper>();
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(r, Eigen::ComputeFullV);
    for (Eigen::Index i = 0; i < columns; ++i) {
        double variance = 0.0;
        for (Eigen::Index j = 0; j < columns; ++j) {
            const double part = svd.matrixV()(i, j);
            const double singular = std::max(svd.singularValues()(j), 1e-9);
            variance += part * part / (singular * singular);
        }
        known[static_cast<std::size_t>(i)] = variance < 1.0;
    }
    return known;
}

}  // namespace scipd::tools
