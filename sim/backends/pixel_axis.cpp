// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/pixel_axis.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace scipd::sim {
namespace {

constexpr int most_pixels = 4096;

}  // namespace

std::vector<double> distinct(std::vector<double> values) {
    std::ranges::sort(values);
    const auto same = [](double a, double b) { return b - a < same_direction; };
    values.erase(std::unique(values.begin(), values.end(), same), values.end());
    return values;
}

std::optional<PixelAxis> even_axis(const std::vector<double>& values, double oversample,
                                   double coarsest_pitch) {
    if (values.size() == 1) return PixelAxis{.first = values.front()};
    const double step = (values.back() - values.front()) / double(values.size() - 1);
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (std::abs(values.front() + double(i) * step - values[i]) > same_direction)
            return std::nullopt;
    }
    const double wanted = std::max(oversample, step / coarsest_pitch);
    const int pieces = std::max(1, static_cast<int>(std::ceil(wanted - same_direction)));
    const auto gaps = static_cast<int>(values.size()) - 1;
    if (gaps * pieces >= most_pixels) return std::nullopt;
    return PixelAxis{values.front(), step / pieces, gaps * pieces + 1};
}

PixelAxis dense_axis(double first, double last, double pitch) {
    if (last - first < same_direction) return {.first = first, .pitch = pitch};
    const int gaps =
        std::clamp(static_cast<int>(std::ceil((last - first) / pitch)), 1, most_pixels - 1);
    return {first, (last - first) / gaps, gaps + 1};
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

}  // namespace scipd::sim
