// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// scipfit: makes of a recording the scanner that made it.
#include <CLI/CLI.hpp>

#include "tools/options.h"
#include "tools/scipfit/scipfit_commands.h"

int main(int argc, char** argv) {
    CLI::App program("Fits a scanner model for scipd to recordings of a real scanner.", "scipfit");
    program.footer(
        "Examples:\n"
        "  scipcat record tcp://192.168.0.10:10940 --intensity -n 400 -o desk.mcap\n"
        "  scipfit desk.mcap -o profile.yaml\n"
        "  scipd --config profile.yaml");
    scipd::tools::add_fit_options(program);
    scipd::tools::add_room_command(program);
    scipd::tools::add_export_command(program);
    scipd::tools::add_completion_command(program, {});
    return scipd::tools::run(program, argc, argv);
}
