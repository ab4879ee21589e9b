// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/faults/fault_values.h"

#include <algorithm>

#include "protocol/command_table.h"

namespace scipd::daemon {

sim::Expected<std::string> parse_code(std::string_view text) {
    constexpr std::string_view letters_of_scip1 = "VLGS";
    const auto table = protocol::command_table();
    const bool of_scip1 = text.size() == 1 && letters_of_scip1.find(text) != std::string_view::npos;
    if (of_scip1 || std::ranges::find(table, text, &protocol::Command::code) != table.end())
        return std::string(text);
    return sim::refuse("must be the code of a command, such as MD, GD, QT or RB, not " +
                       sim::quote(text));
}

}  // namespace scipd::daemon
