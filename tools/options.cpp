// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/options.h"

#include <exception>
#include <iostream>

namespace scipd::tools {

int run(CLI::App& program, int argc, char** argv) {
    constexpr int failed = 1;
    constexpr int wrong_options = 2;
    program.failure_message([](const CLI::App* app, const CLI::Error& error) {
        return app->get_name() + ": " + error.what() + " (see " + app->get_name() + " --help)\n";
    });
    try {
        program.parse(argc, argv);
        return 0;
    } catch (const CLI::ParseError& error) {
        return program.exit(error) == 0 ? 0 : wrong_options;
    } catch (const std::exception& error) {
        std::cerr << program.get_name() << ": " << error.what() << '\n';
        return failed;
    }
}

}  // namespace scipd::tools
