// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/terminal.h"

#include <cstdlib>

#include <sys/ioctl.h>
#include <unistd.h>

namespace scipd::tools {

TerminalSize terminal_size() {
    TerminalSize size;
    winsize window{};
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &window) == 0 && window.ws_col > 0 && window.ws_row > 0) {
        return {window.ws_col, window.ws_row};
    }
    if (const char* const columns = std::getenv("COLUMNS")) {
        const int wanted = std::atoi(columns);
        if (wanted > 0) size.columns = wanted;
    }
    return size;
}

bool stderr_is_terminal() {
    return isatty(STDERR_FILENO) != 0;
}

bool somebody_answers() {
    return stderr_is_terminal() && isatty(STDIN_FILENO) != 0;
}

}  // namespace scipd::tools
