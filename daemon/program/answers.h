// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What scipd answers of itself where there is nothing to run. Any thread; nothing shared.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace scipd::daemon {

/// The end of the program: --help, --version, the lists, a checked configuration, wrong options.
struct Answer {
    /// 2: the text is for standard error, else for standard output; 1: a question answered with no.
    int exit_code = 0;
    std::string text;  ///< with its last line end
};

/// Tables with a row for each product and firmware, and a line for each way to cast.
Answer model_list();
Answer backend_list();
/// What the shell has to read so that it completes the options of `app`.
Answer completion_script(const CLI::App& app, const std::string& shell);
/// Whether this machine has what the backends need. The text tells it either way; the exit code is
/// for scripts.
Answer probe();

}  // namespace scipd::daemon
