// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

namespace scipd::tools {

/// In characters.
struct TerminalSize {
    int columns = 80;
    int rows = 40;
};

/// The size of standard output. If that is no terminal, $COLUMNS if it is set, else the values
/// above.
[[nodiscard]] TerminalSize terminal_size();

/// Whether somebody may be watching what is told beside the results.
[[nodiscard]] bool stderr_is_terminal();

/// Whether a person can be asked something on standard error, and answer on standard input.
[[nodiscard]] bool somebody_answers();

}  // namespace scipd::tools
