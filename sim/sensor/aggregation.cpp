// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/aggregation.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace scipd::sim {
namespace {

constexpr double heard_share = 0.05;

double off_axis_rad(const glm::vec3& direction) {
    return std::atan2(std::hypot(double{direction.y}, double{direction.z}), double{direction.x});
}

std::vector<double> lobe(std::span<const glm::vec3> directions) {
    std::vector<double> weights;
    double rim_rad = 0.0;
    for (const glm::vec3& direction : directions)
        rim_rad = std::max(rim_rad, off_axis_rad(direction));
    for (const glm::vec3& direction : directions) {
        const double part = rim_rad > 0.0 ? off_axis_rad(direction) / rim_rad : 0.0;
        weights.push_back(std::exp(-4.0 * part * part));
    }
    return weights;
}

}  // namespace

Aggregation::Aggregation(Aggregate kind, std::span<const glm::vec3> directions)
    : weights_(kind == Aggregate::weighted ? lobe(directions)
                                           : std::vector<double>(directions.size(), 1.0)),
      share_(kind == Aggregate::weighted ? heard_share : 0.0) {}

// `nearest` needs a share of 0, which the first hit reaches.
std::optional<std::size_t> Aggregation::choose(std::span<const Hit> hits) const {
    assert(hits.size() == weights_.size());
    std::vector<std::size_t> met;
    double came_back = 0.0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        if (!hits[i].met()) continue;
        met.push_back(i);
        came_back += weights_[i];
    }
    if (met.empty()) return std::nullopt;
    std::ranges::stable_sort(met, {}, [&](std::size_t i) { return hits[i].range_m; });
    double heard = 0.0;
    for (const std::size_t i : met) {
        heard += weights_[i];
        if (heard >= share_ * came_back) return i;
    }
    return met.back();
}

}  // namespace scipd::sim
