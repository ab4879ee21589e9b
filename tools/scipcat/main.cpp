// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// scipcat: talks to any SCIP scanner, real or emulated, over TCP or a tty.
#include <CLI/CLI.hpp>

#include "tools/options.h"
#include "tools/scipcat/scipcat_commands.h"

int main(int argc, char** argv) {
    CLI::App program("Talks to any SCIP scanner, real or emulated, over TCP or a tty.", "scipcat");
    program.require_subcommand(1);
    program.footer("scipcat COMMAND --help shows the options of a command.");
    scipd::tools::add_info_command(program);
    scipd::tools::add_record_command(program);
    scipd::tools::add_plot_command(program);
    scipd::tools::add_compare_command(program);
    scipd::tools::add_check_command(program);
    scipd::tools::add_proxy_command(program);
    scipd::tools::add_twin_command(program);
    scipd::tools::add_completion_command(
        program, {{"/plot/--truth", "$(scipctl sensors --names 2>/dev/null)"}});
    return scipd::tools::run(program, argc, argv);
}
