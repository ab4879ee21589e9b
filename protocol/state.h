// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a scanner can be in the midst of, and what can be the matter with it.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace scipd::protocol {

/// The states that decide whether a request is carried out: the columns of the command table.
enum class State {
    standby,    ///< laser off
    measuring,  ///< laser on, no stream of this session
    streaming,  ///< a stream of this session is under way
    adjust,     ///< time-adjust mode
    booting,    ///< only seen on models that answer then
    error,      ///< the device has failed
    asleep,     ///< motor stopped
};
inline constexpr std::array<std::string_view, 7> state_names = {
    "standby", "measuring", "streaming", "adjust", "booting", "error", "asleep"};
inline constexpr std::size_t state_count = state_names.size();

/// What is the matter with the device.
enum class Trouble {
    none,
    unstable,  ///< for a while: streams pause
    laser,     ///< failed: the laser cannot be switched on
    abnormal,  ///< failed otherwise
};

}  // namespace scipd::protocol
