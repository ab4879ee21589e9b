// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/answer.h"

#include <algorithm>

#include "protocol/command_table.h"

namespace scipd::protocol {

std::optional<Answer> parse_answer(std::string_view text) {
    const std::size_t first = text.find(' ');
    const std::size_t last = text.rfind(' ');
    if (first == last) return std::nullopt;
    const std::string_view code = text.substr(0, first);
    const std::string_view state = text.substr(first + 1, last - first - 1);
    const std::string_view status = text.substr(last + 1);
    const auto named = std::find(state_names.begin(), state_names.end(), state);
    const auto commands = command_table();
    const bool known = std::any_of(commands.begin(), commands.end(),
                                   [&](const Command& command) { return command.code == code; });
    const auto parsed = Status::parse(status);
    if (!known || named == state_names.end() || (!parsed && status != "--")) return std::nullopt;
    return Answer{std::string(code), static_cast<State>(named - state_names.begin()), parsed};
}

}  // namespace scipd::protocol
