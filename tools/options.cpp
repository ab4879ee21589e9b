// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/options.h"

#include <exception>
#include <iostream>
#include <sstream>
#include <string>

#include "tools/safe_output.h"

namespace scipd::tools {
namespace {

/// The innermost command that the user has typed.
const CLI::App& command_in(const CLI::App& program) {
    const CLI::App* app = &program;
    while (!app->get_subcommands().empty())
        app = app->get_subcommands().front();
    return *app;
}

/// The text of the error. If a command is missing or unknown, it also lists the commands.
std::string sentence_of(const CLI::App& program, const CLI::Error& error) {
    const CLI::App& app = command_in(program);
    std::string names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        names.append(names.empty() ? "" : ", ").append(command->get_name());
    const bool missing = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
    if (!missing || names.empty()) return error.what();
    const auto unknown = app.remaining();
    std::string sentence = "name a command";
    if (!unknown.empty()) sentence = "there is no command \"" + unknown.front() + "\"";
    return sentence + "; there are: " + names;
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
    return {why_not, limits.str(), "number"};
}

int run(CLI::App& program, int argc, char** argv) {
    constexpr int failed = 1;
    constexpr int wrong_options = 2;
    SafeOutput out(std::cout);
    SafeOutput errors(std::cerr);
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
