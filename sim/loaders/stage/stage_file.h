// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A world file of Stage as a tree of entities with properties, macros expanded as Stage does it.
// Not what Stage makes of them. Any thread; nothing shared.
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
    std::string type;   ///< of Stage, or one that no `define` tells of
    std::string place;  ///< FILE:LINE
    std::map<std::string, std::vector<std::string>, std::less<>> properties;
    std::vector<StageEntity> children;

    /// Null where there is none.
    [[nodiscard]] const std::vector<std::string>* find(std::string_view property) const;
    /// The first value; `otherwise` where there is none.
    [[nodiscard]] std::string text(std::string_view property, const char* otherwise = "") const;
    /// Throws std::invalid_argument where one of them is no number.
    [[nodiscard]] std::vector<double> numbers(std::string_view property) const;
    [[nodiscard]] double number(std::string_view property, double otherwise) const;
};

struct StageFile {
    StageEntity world;  ///< what stands outside of all entities
    std::vector<std::string> warnings;
};

/// Throws LoadError.
StageFile parse_stage(const StageText& world, const FindInclude& find);

}  // namespace scipd::sim
