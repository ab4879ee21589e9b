// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Notices about a configuration that is valid and may not do what its author expects: media and
// materials that no sensor sees, and one serial number of several scanners. Any thread; nothing
// shared.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "daemon/config/config.h"
#include "daemon/plan/known_sensors.h"
#include "sim/world/material_library.h"
#include "sim/world/scene.h"

namespace scipd::daemon {

inline constexpr std::string_view unseen_media =
    "no scanner has accuracy: material, so what fills the air changes no scan";

/// That sentence, if the configuration has media and it is true.
std::vector<std::string> media_notices(const Config& config);

/// A sentence about materials, if the configuration or the world has any that no scanner sees.
/// A name in a world counts if the library knows it and if it is no script of Gazebo.
std::vector<std::string> material_notices(const Config& config, const sim::Scene& scene,
                                          const sim::MaterialLibrary& library);

/// A sentence for each number that several scanners have of which one is not running: they are the
/// same unit, and read too far by the same. Where each says its bias itself, that is nobody's
/// mistake.
[[nodiscard]] std::vector<std::string> serial_notices(const Config& config,
                                                      const KnownSensors& running);

}  // namespace scipd::daemon
