// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/fleet/nearness.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace scipd::daemon {

// With smaller cells a position would not fit into one number.
Nearness::Nearness(double near_m) : size_m_(std::max(near_m, 1.0)) {}

Nearness::Cell Nearness::cell_at(double x_m, double y_m) const {
    const auto number = [&](double at_m) {
        return static_cast<std::uint32_t>(static_cast<std::int32_t>(std::floor(at_m / size_m_)));
    };
    return Cell{number(x_m)} << 32U | number(y_m);
}

bool Nearness::is_near(const glm::dvec3& at_m) const {
    return near_.contains(cell_at(at_m.x, at_m.y));
}

std::vector<sim::PoseLine> Nearness::look_around(const std::vector<glm::dvec3>& robots_m) {
    near_.clear();
    for (const glm::dvec3& robot_m : robots_m) {
        for (const double x : {-size_m_, 0.0, size_m_}) {
            for (const double y : {-size_m_, 0.0, size_m_})
                near_.insert(cell_at(robot_m.x + x, robot_m.y + y));
        }
    }
    std::vector<sim::PoseLine> back;
    std::erase_if(far_, [&](auto& entry) {
        if (!is_near(entry.second.pose.translation_m)) return false;
        back.push_back(std::move(entry.second));
        return true;
    });
    return back;
}

// The first pose that is far takes the model away from where it was seen last.
bool Nearness::matters(const sim::PoseLine& line) {
    if (is_near(line.pose.translation_m)) {
        far_.erase(line.model);
        return true;
    }
    const auto [place, leaves] = far_.insert_or_assign(line.model, line);
    return leaves;
}

}  // namespace scipd::daemon
