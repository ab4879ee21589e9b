// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/completion_command.h"

#include <iostream>
#include <memory>
#include <string>

namespace scipd::tools {

void add_completion_command(CLI::App& program, const daemon::MoreWords& more) {
    auto* const command = program.add_subcommand("completion", "print completions for a shell");
    const auto shell = std::make_shared<std::string>();
    command->add_option("SHELL", *shell, "bash, zsh or fish")
        ->required()
        ->check(CLI::IsMember(daemon::completion_shells()));
    command->callback(
        [&program, shell, more] { std::cout << daemon::completions(program, *shell, more); });
    command->footer("Example:\n  source <(" + program.get_name() + " completion bash)");
}

}  // namespace scipd::tools
