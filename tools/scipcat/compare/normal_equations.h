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

    /// By what to change the unknowns so that the residuals become least. Each unknown must be in
    /// some residual.
    [[nodiscard]] Vector solve() const {
        Vector wanted = sums_;
        for (double& value : wanted)
            value = -value;
        return backward(forward(wanted));
    }

    /// How the unknowns vary together, if residuals have a deviation of 1.
    [[nodiscard]] std::array<Vector, size> covariance() const {
        std::array<Vector, size> columns{};
        for (std::size_t i = 0; i < size; ++i) {
            columns[i][i] = 1;
            columns[i] = backward(forward(columns[i]));
        }
        return columns;
    }

  private:
    /// By A.-L. Cholesky.
    [[nodiscard]] std::array<Vector, size> root() const {
        std::array<Vector, size> root{};
        for (std::size_t row = 0; row < size; ++row) {
            for (std::size_t column = 0; column <= row; ++column) {
                double rest = squares_[row][column];
                for (std::size_t k = 0; k < column; ++k)
                    rest -= root[row][k] * root[column][k];
                root[row][column] = row == column ? std::sqrt(rest) : rest / root[column][column];
            }
        }
        return root;
    }
    [[nodiscard]] Vector forward(Vector values) const {
        const auto factors = root();
        for (std::size_t row = 0; row < size; ++row) {
            for (std::size_t k = 0; k < row; ++k)
                values[row] -= factors[row][k] * values[k];
            values[row] /= factors[row][row];
        }
        return values;
    }
    [[nodiscard]] Vector backward(Vector values) const {
        const auto factors = root();
        for (std::size_t row = size; row-- > 0;) {
            for (std::size_t k = row + 1; k < size; ++k)
                values[row] -= factors[k][row] * values[k];
            values[row] /= factors[row][row];
        }
        return values;
    }

    std::array<Vector, size> squares_{};  ///< below the diagonal
    Vector sums_{};
};

}  // namespace scipd::tools::comparing
