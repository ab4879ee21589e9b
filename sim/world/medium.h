// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What fills the air: rain, fog, snow or dust, everywhere or in a box of the world. It takes light
// away, and its drops and flakes send some back. Values; any thread.
#pragma once

#include <limits>
#include <string>

#include <glm/vec3.hpp>

namespace scipd::sim {

struct Medium {
    std::string name;
    /// The corners of its box in W. Left as they are: everywhere.
    glm::dvec3 low_m{-std::numeric_limits<double>::infinity()};
    glm::dvec3 high_m{std::numeric_limits<double>::infinity()};
    /// Light that goes r metres through it loses all but exp(-extinction_per_m * r).
    double extinction_per_m = 0.0;
    /// How many drops or flakes that a scanner can tell apart a beam meets on a metre, on average.
    double returns_per_m = 0.0;
    /// What one of them sends back, relative to a white matt face that fills the beam.
    double brightness = 0.0;
    /// How somebody said it, for those who show it: "fog", "rain", "snow", "dust" or "custom".
    std::string kind = "custom";
    /// Metres of visibility of fog and dust, millimetres an hour of rain and snow.
    double amount = 0.0;

    bool operator==(const Medium&) const = default;
};

/// Fog in which things are just visible over so many metres (meteorological visibility V).
/// Koschmieder 1924: the extinction is 3.912 / V. In fog of less than 500 m it is the same for the
/// light of a scanner (Kim, McArthur, Korevaar 2001). It sends back 0.046 / V per steradian and
/// metre (Hahner et al., Fog simulation on real LiDAR point clouds, 2021), over half a metre of a
/// pulse. That it does so once in each mean free path is assumed.
[[nodiscard]] Medium fog(double visibility_m);
/// Rain of R millimetres an hour. The drops that Marshall and Palmer 1948 counted, 8000 exp(-4.1
/// R^-0.21 D) per cubic metre and millimetre of diameter, take away twice the light that falls on
/// them: 3.65e-4 R^0.63 per metre. How many of them show, and how bright, is assumed.
[[nodiscard]] Medium rain(double mm_per_hour);
/// Snow of R millimetres of water an hour: the same with the flakes of Gunn and Marshall 1958,
/// 1.44e-3 R^0.57 per metre. How many of them show, and how bright, is assumed.
[[nodiscard]] Medium snow(double mm_per_hour);
/// Dust or smoke with this visibility: Koschmieder's extinction. How many grains show, and how
/// bright, is assumed.
[[nodiscard]] Medium dust(double visibility_m);

}  // namespace scipd::sim
