// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Weighted least squares of a few unknowns. A value; any thread.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace scipd::tools::comparing {

template <std::size_t size>
class NormalEquations {
  public:
    using Vector = std::array<double, size>;

    void add(const Vector& gradient, double residual, double weight) {
        for (std::size_t row = 0; row < size; ++row) {
            sums_[row] += weight * gradient[row] * residual;
            for (std::size_t column = 0; column <= row; ++column)
                squares_[row][column] += weight * gradient[row] * gradient[column];
        }
    }

    /// By what to change the unknowns so that the residuals become least. By Cholesky: each unknown
    /// must be in some residual.
    [[nodiscard]] Vector solve() const {
        std::array<Vector, size> root{};
        for (std::size_t row = 0; row < size; ++row) {
            for (std::size_t column = 0; column <= row; ++column) {
                double rest = squares_[row][column];
                for (std::size_t k = 0; k < column; ++k)
                    rest -= root[row][k] * root[column][k];
                root[row][column] = row == column ? std::sqrt(rest) : rest / root[column][column];
            }
        }
        return backward(root, forward(root));
    }

  private:
    [[nodiscard]] Vector forward(const std::array<Vector, size>& root) const {
        Vector solved{};
        for (std::size_t row = 0; row < size; ++row) {
            solved[row] = -sums_[row];
            for (std::size_t k = 0; k < row; ++k)
                solved[row] -= root[row][k] * solved[k];
            solved[row] /= root[row][row];
        }
        return solved;
    }
    static Vector backward(const std::array<Vector, size>& root, Vector solved) {
        for (std::size_t row = size; row-- > 0;) {
            for (std::size_t k = row + 1; k < size; ++k)
                solved[row] -= root[k][row] * solved[k];
            solved[row] /= root[row][row];
        }
        return solved;
    }

    std::array<Vector, size> squares_{};  ///< below the diagonal
    Vector sums_{};
};

}  // namespace scipd::tools::comparing
