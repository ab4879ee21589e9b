// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/sdf_cost.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <tinyxml2.h>

namespace scipd::sim {
namespace {

/// Memory that libsdformat 12.3 takes for an element, measured on files with a thousand of them.
struct Cost {
    std::string_view element;
    double bytes;
};
constexpr std::array costs{Cost{"model", 1.4e6},  Cost{"link", 0.85e6},   Cost{"joint", 0.6e6},
                           Cost{"sensor", 0.6e6}, Cost{"visual", 0.17e6}, Cost{"collision", 0.17e6},
                           Cost{"frame", 12e3}};
constexpr double other_element_bytes = 2e3;

}  // namespace

double bytes_for(std::string_view element) {
    const auto known = std::ranges::find(costs, element, &Cost::element);
    return known == costs.end() ? other_element_bytes : known->bytes;
}

double bytes_for_robot(const tinyxml2::XMLElement& element) {
    double bytes = bytes_for(element.Name());
    for (const auto* child = element.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement())
        bytes += bytes_for_robot(*child);
    return bytes;
}

std::string megabytes(double bytes) {
    return std::to_string(static_cast<long>(std::min(1e15, std::ceil(bytes / 1e6)))) + " MB";
}

}  // namespace scipd::sim
