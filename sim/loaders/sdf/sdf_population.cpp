// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Spreads a <population>.
#include <cmath>
#include <numbers>
#include <string>

#include "sim/loaders/file/xml_tree.h"
#include "sim/loaders/sdf/sdf_world.h"

namespace scipd::sim {
namespace {

using tinyxml2::XMLElement;

constexpr double most_models = 10'000;

const XMLElement& needed_child(const XMLElement& element, const char* name) {
    const auto* child = element.FirstChildElement(name);
    if (child == nullptr) throw UnreadableValue("has no <" + std::string{name} + ">");
    return *child;
}

/// A number above 0.
double size_in(const SdfValues& values, const char* name) {
    const double size = values.number(name).value_or(0.0);
    if (!(size > 0.0)) throw UnreadableValue("its <" + std::string{name} + "> must be above 0");
    return size;
}

int count_in(const SdfValues& values, const char* name) {
    const double count = size_in(values, name);
    if (count < 1.0 || count > most_models) {
        throw UnreadableValue("its <" + std::string{name} + "> must be 1 to 10000");
    }
    return static_cast<int>(count);
}

/// The i-th of points that fill a cube evenly: multiples of the powers of the number that solves
/// x^4 = x + 1 (Roberts, The unreasonable effectiveness of quasirandom sequences, 2018).
glm::dvec3 evenly(int i) {
    constexpr double g = 1.2207440846057596;
    const glm::dvec3 at = 0.5 + (i + 1.0) * glm::dvec3{1.0 / g, 1.0 / (g * g), 1.0 / (g * g * g)};
    return at - glm::floor(at);
}

class Region {
  public:
    Region(const XMLElement& population, const Dialect& dialect) {
        if (const auto* box = population.FirstChildElement("box")) {
            size_m_ = SdfValues(*box, dialect).vector("size").value_or(glm::dvec3{0.0});
        } else if (const auto* cylinder = population.FirstChildElement("cylinder")) {
            const SdfValues values(*cylinder, dialect);
            radius_m_ = size_in(values, "radius");
            size_m_ = {2.0 * radius_m_, 2.0 * radius_m_, size_in(values, "length")};
        } else {
            throw UnreadableValue("has neither <box> nor <cylinder>");
        }
        if (!(size_m_.x > 0.0 && size_m_.y > 0.0 && size_m_.z > 0.0)) {
            throw UnreadableValue("its <size> must be above 0");
        }
    }

    /// From its middle, for a share of 0 to 1 of each side.
    [[nodiscard]] glm::dvec3 at_m(const glm::dvec3& share) const {
        if (radius_m_ == 0.0) return (share - 0.5) * size_m_;
        const double from_axis_m = radius_m_ * std::sqrt(share.x);
        const double turn_rad = 2.0 * std::numbers::pi * share.y;
        return {from_axis_m * std::cos(turn_rad), from_axis_m * std::sin(turn_rad),
                (share.z - 0.5) * size_m_.z};
    }

  private:
    glm::dvec3 size_m_{0.0};
    double radius_m_ = 0.0;
};

std::vector<glm::dvec3> grid(const SdfValues& distribution) {
    const int rows = count_in(distribution, "rows");
    const int columns = count_in(distribution, "cols");
    if (double{1.0} * rows * columns > most_models) {
        throw UnreadableValue("has more than 10000 models");
    }
    const glm::dvec3 step_m = distribution.vector("step").value_or(glm::dvec3{0.0});
    std::vector<glm::dvec3> places_m;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            places_m.emplace_back(step_m.x * (column - 0.5 * (columns - 1)),
                                  step_m.y * (row - 0.5 * (rows - 1)), 0.0);
        }
    }
    return places_m;
}

std::vector<glm::dvec3> in_region(const XMLElement& population, const Dialect& dialect,
                                  const std::string& type) {
    const Region region(population, dialect);
    const int count = count_in(SdfValues(population, dialect), "model_count");
    std::vector<glm::dvec3> places_m;
    for (int i = 0; i < count; ++i) {
        glm::dvec3 share = evenly(i);
        if (type.starts_with("linear-")) {
            share = glm::dvec3{0.5};
            share[type.back() - 'x'] = static_cast<double>(i) / count;
        }
        places_m.push_back(region.at_m(share));
    }
    return places_m;
}

}  // namespace

std::vector<glm::dvec3> places_of_population(const XMLElement& population, const Dialect& dialect) {
    const XMLElement& distribution = needed_child(population, "distribution");
    const std::string type = text_of(distribution.FirstChildElement("type"));
    const bool is_known = type == "random" || type == "uniform" || type == "linear-x" ||
                          type == "linear-y" || type == "linear-z";
    if (type != "grid" && !is_known) {
        throw UnreadableValue(
            "its <type> must be random, uniform, grid, linear-x, linear-y or linear-z");
    }
    auto places_m = type == "grid" ? grid(SdfValues(distribution, dialect))
                                   : in_region(population, dialect, type);
    const Pose middle = SdfValues(population, dialect).pose().pose;
    for (glm::dvec3& place_m : places_m)
        place_m = middle * place_m;
    return places_m;
}

}  // namespace scipd::sim
