// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/unseen_media.h"

#include <algorithm>

namespace scipd::daemon {

std::vector<std::string> media_notices(const Config& config) {
    const bool seen = std::ranges::any_of(config.robots, [](const RobotConfig& robot) {
        return std::ranges::any_of(robot.sensors, &SensorConfig::sees_light);
    });
    if (config.media.empty() || seen) return {};
    return {config.place_of("media") + std::string(unseen_media)};
}

}  // namespace scipd::daemon
