// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/world/material.h"

#include <algorithm>
#include <cmath>

namespace scipd::sim {
namespace {

std::optional<double> share_of(std::optional<double> number) {
    if (!number || std::isnan(*number)) return std::nullopt;
    return std::clamp(*number, 0.0, 1.0);
}

std::optional<double> above_zero(std::optional<double> share) {
    return share && *share > 0.0 ? share : std::nullopt;
}

}  // namespace

Appearance as_said(std::optional<double> transparency, std::optional<double> metalness,
                   std::optional<double> roughness) {
    Appearance said{.transparency = above_zero(share_of(transparency)),
                    .metalness = above_zero(share_of(metalness))};
    if (said.metalness) said.roughness = share_of(roughness);
    return said;
}

}  // namespace scipd::sim
