// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Parses a world file of Stage into a tree of entities with properties, and expands macros as Stage
// does. stage_scene.h tells what the entities mean. Any thread; nothing shared.
#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "sim/loaders/stage/stage_tokens.h"

namespace scipd::sim {

/// `type ( property 1  property [ 1 2 ]  type ( ... ) )`
struct StageEntity {
    std::string type;   ///< one of Stage's, or an unknown one that no `define` explains
    std::string place;  ///< FILE:LINE
    std::map<std::string, std::vector<std::string>, std::less<>> properties;
    std::vector<StageEntity> children;

    /// Null if there is no such property.
    [[nodiscard]] const std::vector<std::string>* find(std::string_view property) const;
    /// The first value; `otherwise` if there is none.
    [[nodiscard]] std::string text(std::string_view property, const char* otherwise = "") const;
    /// Throws std::invalid_argument if a value is no number.
    [[nodiscard]] std::vector<double> numbers(std::string_view property) const;
    [[nodiscard]] double number(std::string_view property, double otherwise) const;
};

struct StageFile {
    StageEntity world;  ///< the properties and entities outside all others
    std::vector<std::string> warnings;
};

/// Throws LoadError.
StageFile parse_stage(const StageText& world, const FindInclude& find);

}  // namespace scipd::sim
