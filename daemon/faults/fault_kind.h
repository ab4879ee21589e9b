// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// All kinds of faults, one row each. A new kind is a class in the *_effects.cpp of its layer and a
// row there. Any thread; nothing shared.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/config/members.h"
#include "daemon/faults/fault_effect.h"
#include "sim/loaders/yaml/yaml_section.h"

namespace scipd::daemon {

using MakeEffect = std::function<std::unique_ptr<FaultEffect>()>;

struct FaultKind {
    std::string_view name;   ///< "corrupt"
    std::string_view layer;  ///< "link", "protocol", "device", "scans" or "world"
    std::string_view summary;
    /// Without `for` and `until` it is over as soon as it has begun; else it lasts until it is
    /// stopped.
    bool momentary;
    /// The keys of the kind's own members.
    std::vector<std::string_view> (*keys)();
    /// Reads the kind's own members of a fault. What is wrong becomes a fault of its field.
    MakeEffect (*read)(const sim::YamlField& fault, const sim::YamlSection& section,
                       sim::YamlFaults& faults);
};

/// A row for an effect. It has a `struct Members`, which its constructor takes, a table `members`
/// of them, and `static void check(const Members&, const Field& fault, Faults&)` for what a single
/// member cannot tell.
template <class Effect>
constexpr FaultKind kind_of(std::string_view name, std::string_view layer, std::string_view summary,
                            bool momentary = false) {
    return {
        .name = name,
        .layer = layer,
        .summary = summary,
        .momentary = momentary,
        .keys = [] { return keys_of(Effect::members); },
        .read =
            [](const sim::YamlField& fault, const sim::YamlSection& section,
               sim::YamlFaults& faults) {
                typename Effect::Members members;
                const std::size_t before = faults.count();
                read_members(section, Effect::members, members, faults);
                if (faults.count() == before) Effect::check(members, fault, faults);
                return MakeEffect([members] { return std::make_unique<Effect>(members); });
            },
    };
}

// One for each layer.
std::span<const FaultKind> byte_kinds();     ///< byte_effects.cpp
std::span<const FaultKind> line_kinds();     ///< line_effects.cpp
std::span<const FaultKind> cut_kinds();      ///< cut_effects.cpp
std::span<const FaultKind> message_kinds();  ///< message_effects.cpp
std::span<const FaultKind> device_kinds();   ///< device_effects.cpp
std::span<const FaultKind> clock_kinds();    ///< clock_effects.cpp
std::span<const FaultKind> repeat_kinds();   ///< repeat_effects.cpp
std::span<const FaultKind> scan_kinds();     ///< scan_effects.cpp
std::span<const FaultKind> window_kinds();   ///< window_effects.cpp
std::span<const FaultKind> pose_kinds();     ///< pose_effects.cpp

/// All of them, in the order of the layers.
std::vector<const FaultKind*> fault_kinds();
/// Those that touch bytes and messages alone: a proxy has them as well.
std::vector<const FaultKind*> wire_kinds();
/// Null: there is none of that name.
const FaultKind* find_fault_kind(std::string_view name);

}  // namespace scipd::daemon
