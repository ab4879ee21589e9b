// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/options.h"

#include <cstdint>
#include <exception>
#include <iostream>
#include <limits>
#include <sstream>
#include <string>

#include "daemon/command_line/help_text.h"
#include "daemon/command_line/unknown_word.h"
#include "daemon/command_line/version.h"
#include "tools/safe_output.h"

namespace scipd::tools {
namespace {

/// Bounds that nobody comes near are nothing to read about.
std::string bounds_in_help(const std::string& bounds, double most) {
    constexpr double nobody_asks_for = 1e6;
    return most < nobody_asks_for ? bounds : "";
}

/// The commands that could have been named where one is missing.
std::string commands_of(const CLI::App& program) {
    const CLI::App* app = &program;
    while (!app->get_subcommands().empty())
        app = app->get_subcommands().front();
    std::string names;
    for (const CLI::App* command : app->get_subcommands([](const CLI::App*) { return true; }))
        names.append(names.empty() ? "" : ", ").append(command->get_name());
    return names;
}

std::string sentence_of(const CLI::App& program, const CLI::Error& error) {
    const bool missing = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
    const bool extra = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
    // Where a word is misspelt, what it should have been is missing.
    if (missing || extra) {
        if (auto unknown = daemon::unknown_word(program)) return *std::move(unknown);
    }
    const std::string commands = missing ? commands_of(program) : "";
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

int run(CLI::App& program, int argc, char** argv) {
    constexpr int failed = 1;
    constexpr int wrong_options = 2;
    SafeOutput out(std::cout);
    SafeOutput errors(std::cerr);
    daemon::use_our_help(program);
    program.set_version_flag("--version", daemon::version_of(program.get_name()),
                             "print the version");
    program.failure_message([](const CLI::App* app, const CLI::Error& error) {
        return app->get_name() + ": " + sentence_of(*app, error) + " (see " + app->get_name() +
               " --help)\n";
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
