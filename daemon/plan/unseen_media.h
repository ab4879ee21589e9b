// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a user should know who fills the air of a world, or says how its faces reflect, where no
// sensor sees light. Any thread; nothing shared.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "daemon/config/config.h"
#include "sim/world/material_library.h"
#include "sim/world/scene.h"

namespace scipd::daemon {

inline constexpr std::string_view unseen_media =
    "no scanner has accuracy: material, so what fills the air changes no scan";

/// That sentence, if the configuration has media and it is true.
std::vector<std::string> media_notices(const Config& config);

/// That sentence about materials, if the configuration or the world has any that no scanner sees.
/// A name in a world counts if the library knows it and if it is no script of Gazebo.
std::vector<std::string> material_notices(const Config& config, const sim::Scene& scene,
                                          const sim::MaterialLibrary& library);

}  // namespace scipd::daemon
