// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/command_line/unknown_word.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "sim/text/near_word.h"
#include "sim/text/quote.h"

namespace scipd::daemon {
namespace {

using Words = std::vector<std::string>;

/// The innermost command that was typed.
const CLI::App& command_in(const CLI::App& program) {
    const CLI::App* app = &program;
    while (!app->get_subcommands().empty())
        app = app->get_subcommands().front();
    return *app;
}

Words commands_of(const CLI::App& app) {
    Words names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(command->get_name());
    return names;
}

/// Long options of this command and, with fallthrough, of its parent commands.
Words options_of(const CLI::App& app) {
    Words names;
    for (const CLI::App* place = &app; place != nullptr;) {
        for (const CLI::Option* option : place->get_options()) {
            for (const std::string& name : option->get_lnames())
                names.push_back("--" + name);
        }
        place = place->get_fallthrough() ? place->get_parent() : nullptr;
    }
    return names;
}

std::string did_you_mean(const std::string& word, const Words& known,
                         const Replacement& replacement = {}) {
    std::string better = replacement ? replacement(word) : "";
    const std::vector<std::string_view> views(known.begin(), known.end());
    if (better.empty()) better = sim::meant(word, views).value_or("");
    return better.empty() ? "" : "; did you mean " + sim::printable(better) + "?";
}

}  // namespace

std::string commands_after(const CLI::App& program) {
    return sim::listed(commands_of(command_in(program)));
}

std::optional<std::string> unknown_word(const CLI::App& program, const Replacement& replacement) {
    const Words unknown = program.remaining(true);
    if (unknown.empty()) return std::nullopt;
    const CLI::App& app = command_in(program);
    // The value of an unknown option is unknown, too, and may come first.
    const auto option = std::ranges::find_if(
        unknown, [](const std::string& word) { return word.size() > 1 && word.front() == '-'; });
    if (option != unknown.end()) {
        const std::string name = option->substr(0, option->find('='));
        return "there is no option " + sim::printable(name) +
               did_you_mean(name, options_of(app), replacement);
    }
    const std::string& word = unknown.front();
    const Words commands = commands_of(app);
    if (commands.empty())
        return "unexpected argument " + sim::quote(word) + did_you_mean(word, {}, replacement);
    const std::string near = did_you_mean(word, commands);
    return "there is no command \"" + sim::printable(word, 40) + "\"" + near +
           (near.empty() ? "; there are: " : " There are: ") + sim::listed(commands);
}

}  // namespace scipd::daemon
