// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <cstdint>
#include <string>

namespace scipd::sim {

/// Index into Scene::materials.
using MaterialId = std::uint32_t;

/// What a surface is made of. Scanners tell materials apart by name; the first of a scene is always
/// "default".
struct Material {
    std::string name;
};

}  // namespace scipd::sim
