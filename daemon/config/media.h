// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Makes what fills the air of a world from what a user says of it. Files (read_media()) and the
// control API have the same keys, bounds and sentences. Any thread; nothing shared.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "sim/world/medium.h"

namespace scipd::sim {
class YamlFaults;
struct YamlField;
}  // namespace scipd::sim

namespace scipd::daemon {

inline constexpr std::size_t most_media = 64;

/// One medium in the user's words.
struct MediumRequest {
    std::string kind;
    std::string name;                                    ///< empty: as its kind
    std::map<std::string, double, std::less<>> numbers;  ///< by their keys
    std::optional<std::array<glm::dvec3, 2>> box_m;      ///< two of its corners; else everywhere
};

/// The keys of a medium whose values are numbers.
std::span<const std::string_view> medium_numbers();
/// What the amount of a medium of this kind is called; empty where it has none.
std::string_view amount_key(std::string_view kind);

/// Takes a fault of a medium: the key, empty for the whole of it, and what follows the key in a
/// sentence.
using TellFault = std::function<void(std::string_view key, const std::string& why)>;

/// Adds the medium to those before it, unless it has a fault. Tells every fault.
void add_medium(const MediumRequest& request, std::vector<sim::Medium>& media,
                const TellFault& tell);

/// `list` is the value of the root's key `media`.
std::vector<sim::Medium> read_media(const sim::YamlField& list, sim::YamlFaults& faults);

}  // namespace scipd::daemon
