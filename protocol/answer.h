// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The states that decide whether a request is carried out, and single cells of the command table in
// which a model differs from its family. Values; no thread rule.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/status.h"

namespace scipd::protocol {

enum class State {
    standby,    ///< laser off
    measuring,  ///< laser on, no stream of this session
    streaming,  ///< a stream of this session is under way
    adjust,     ///< time-adjust mode
    booting,    ///< only seen on models that answer then
    error,      ///< laser trouble or abnormal
    asleep,     ///< motor stopped
};
inline constexpr std::array<std::string_view, 7> state_names = {
    "standby", "measuring", "streaming", "adjust", "booting", "error", "asleep"};
inline constexpr std::size_t state_count = state_names.size();

struct Answer {
    std::string command;  ///< its code
    State state = State::standby;
    std::optional<Status> status;  ///< nothing: it is carried out

    bool operator==(const Answer&) const = default;
};

/// "QT adjust 00": a code of the command table, a state by its name, and a status or -- where the
/// command is carried out. Nothing where the text is none.
[[nodiscard]] std::optional<Answer> parse_answer(std::string_view text);

}  // namespace scipd::protocol
