// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where something that moves has been since some time, roughly: a ball that it has not left. Of ten
// thousand models a sweep has to tell quickly which ones are far away. A value; no thread rule.
#pragma once

#include <algorithm>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "sim/time.h"

namespace scipd::daemon {

struct Ball {
    glm::dvec3 middle_m{0.0};
    double radius_m = 0.0;
};

class Whereabouts {
  public:
    /// Nothing is known.
    Whereabouts() = default;
    /// It is there from this time on, with all its points in this ball.
    Whereabouts(const Ball& ball, sim::Time since)
        : at_m_(ball.middle_m), radius_m_(ball.radius_m), last_m_(at_m_), since_(since) {}

    /// It went straight there, or jumped, and goes on by up to `on_m`. It was where it was before
    /// until `left`, or went on from there.
    void goes_to(const glm::dvec3& to_m, sim::Time left, double on_m = 0.0) {
        constexpr double most_strays_m = 2.0;
        const double before_m = std::exchange(on_m_, on_m);
        const double strays_m = std::max(strays_m_, glm::distance(at_m_, to_m) + on_m);
        if (strays_m <= most_strays_m) {
            strays_m_ = strays_m;
        } else if (since_ != unknown) {
            at_m_ = to_m;
            strays_m_ = std::max(glm::distance(last_m_, to_m) + before_m, on_m);
            since_ = left;
        }
        last_m_ = to_m;
    }

    /// Whether none of it is in the ball at any time from this one on.
    [[nodiscard]] bool is_outside(const Ball& ball, sim::Time from) const {
        const double reach_m = ball.radius_m + radius_m_ + strays_m_;
        const glm::dvec3 apart_m = at_m_ - ball.middle_m;
        return from >= since_ && glm::dot(apart_m, apart_m) > reach_m * reach_m;
    }

  private:
    static constexpr sim::Time unknown = sim::Time::max();

    glm::dvec3 at_m_{0.0};
    double radius_m_ = 0.0;
    double strays_m_ = 0.0;
    double on_m_ = 0.0;  ///< from where it went last
    glm::dvec3 last_m_{0.0};
    sim::Time since_ = unknown;
};

}  // namespace scipd::daemon
