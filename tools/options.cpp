// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/options.h"

#include <cstdint>
#include <exception>
#include <iostream>
#include <limits>
#include <memory>
#include <sstream>
#include <string>

#include "daemon/command_line/help_text.h"
#include "daemon/command_line/unknown_word.h"
#include "daemon/command_line/version.h"
#include "tools/safe_output.h"

namespace scipd::tools {
namespace {

/// Empty for bounds too wide to matter.
std::string bounds_in_help(const std::string& bounds, double most) {
    constexpr double widest_in_help = 1e6;
    return most < widest_in_help ? bounds : "";
}

std::string sentence_of(const CLI::App& program, const CLI::Error& error) {
    const bool missing = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
    const bool extra = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
    // Where a word is misspelt, what it should have been is missing.
    if (missing || extra) {
        if (auto unknown = daemon::unknown_word(program)) return *std::move(unknown);
    }
    const std::string commands = missing ? daemon::commands_after(program) : "";
    return commands.empty() ? error.what() : "name a command; there are: " + commands;
}

}  // namespace

CLI::Validator number_within(double least, double most) {
    std::ostringstream limits;
    limits << least << " to " << most;
    const auto why_not = [=, limits = limits.str()](const std::string& text) -> std::string {
        double number = 0.0;
        // This also refuses nan, with which every comparison is false.
        if (CLI::detail::lexical_cast(text, number) && number >= least && number <= most) return {};
        return "must be a number from " + limits + ", not \"" + text + "\"";
    };
    return {why_not, bounds_in_help(limits.str(), most), "number"};
}

CLI::Validator whole_within(std::int64_t least, std::int64_t most) {
    const std::string limits = std::to_string(least) + " to " + std::to_string(most);
    const auto why_not = [=](const std::string& text) -> std::string {
        std::int64_t number = 0;
        if (CLI::detail::lexical_cast(text, number) && number >= least && number <= most) return {};
        return "must be a whole number from " + limits + ", not \"" + text + "\"";
    };
    return {why_not, bounds_in_help(limits, static_cast<double>(most)), "whole number"};
}

CLI::Validator whole_from(std::int64_t least) {
    constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
    const std::string advice = "must be a whole number, " + std::to_string(least) + " or more";
    const auto why_not = [=](const std::string& text) -> std::string {
        std::int64_t number = 0;
        if (CLI::detail::lexical_cast(text, number) && number >= least && number <= most) return {};
        return advice + ", not \"" + text + "\"";
    };
    return {why_not, "", "whole number"};
}

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

int run(CLI::App& program, int argc, char** argv) {
    constexpr int failed = 1;
    constexpr int wrong_options = 2;
    SafeOutput out(std::cout);
    SafeOutput errors(std::cerr);
    daemon::use_our_help(program);
    program.set_version_flag("--version", daemon::version_of(program.get_name()),
                             "print the version");
    program.failure_message([](const CLI::App* app, const CLI::Error& error) {
        const bool value = dynamic_cast<const CLI::ValidationError*>(&error) != nullptr;
        return app->get_name() + ": " + sentence_of(*app, error) +
               (value ? "" : " (see " + app->get_name() + " --help)") + '\n';
    });
    try {
        program.parse(argc, argv);
        return 0;
    } catch (const CLI::ParseError& error) {
        return program.exit(error) == 0 ? 0 : wrong_options;
    } catch (const WrongInput& error) {
        std::cerr << program.get_name() << ": " << error.what() << '\n';
        return wrong_options;
    } catch (const std::exception& error) {
        std::cerr << program.get_name() << ": " << error.what() << '\n';
        return failed;
    }
}

}  // namespace scipd::tools
