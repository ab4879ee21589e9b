// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Every command that is understood, one row each: a new command is a row here and its handler. The
// scanner's side, the host's side and the tests read the same table.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "protocol/command.h"
#include "protocol/device_profile.h"

namespace scipd::protocol {

[[nodiscard]] std::span<const Command> command_table();

/// What the model answers in this state instead of carrying the command out.
[[nodiscard]] std::optional<Status> refusal(const Command& command, State state,
                                            const DeviceProfile& profile);

/// The command that `line` begins with, the longest code first; null where the model knows none.
[[nodiscard]] const Command* find_command(std::string_view line, const DeviceProfile& profile);

/// "QT adjust 00": the code of a command, a state by its name, and a status or -- where the command
/// is carried out. Nothing where the text is no such cell.
[[nodiscard]] std::optional<Deviation> parse_deviation(std::string_view text);

}  // namespace scipd::protocol
