// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Writes completions for shells, generated from the program's own commands and options.
#include <iostream>
#include <map>
#include <memory>
#include <string>

#include "tools/scipctl/commands.h"

namespace scipd::tools {
namespace {

/// The words that may follow each command: "/pose" has "get set play stream --control --help".
/// $(..) among them are run when somebody asks for completions.
using Words = std::map<std::string, std::string>;

void add_options(const CLI::App& app, std::string& words) {
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames())
            words.append(words.empty() ? "--" : " --").append(name);
    }
}

/// `inherited` are the options of the enclosing commands, which may follow as well.
void collect(const CLI::App& app, const std::string& path, const std::string& inherited,
             Words& all) {
    const auto subcommands = app.get_subcommands([](const CLI::App*) { return true; });
    std::string words;
    for (const CLI::App* subcommand : subcommands)
        words.append(words.empty() ? "" : " ").append(subcommand->get_name());
    add_options(app, words);
    all[path] = words + inherited;
    for (const CLI::App* subcommand : subcommands)
        collect(*subcommand, path + "/" + subcommand->get_name(), " --control", all);
}

/// Prints a case for each command: its words between `begin` and `end`.
void print_cases(const Words& words, const char* begin, const char* end) {
    for (const auto& [path, list] : words)
        std::cout << "    \"" << path << "\") " << begin << list << end << " ;;\n";
}

/// Prints code that sets $command to the command typed so far. `typed` are the words before the
/// cursor.
void print_command(const Words& words, const char* typed) {
    std::cout << "  local command='' word\n  for word in " << typed
              << "; do\n    case \"$command/$word\" in\n      ";
    bool first = true;
    for (const auto& [path, list] : words) {
        if (path.empty()) continue;
        std::cout << (first ? "" : "|") << path;
        first = false;
    }
    std::cout << ") command=\"$command/$word\" ;;\n    esac\n  done\n  case \"$command\" in\n";
}

void print_bash(const Words& words) {
    std::cout << "# Completions of scipctl for bash.\n_scipctl() {\n";
    print_command(words, "\"${COMP_WORDS[@]:1:COMP_CWORD-1}\"");
    print_cases(words, "word=\"", "\"");
    std::cout << "  esac\n"
                 "  COMPREPLY=($(compgen -W \"$word\" -- \"${COMP_WORDS[COMP_CWORD]}\"))\n"
                 "}\ncomplete -o default -F _scipctl scipctl\n";
}

void print_zsh(const Words& words) {
    std::cout << "#compdef scipctl\n# Completions of scipctl for zsh.\n_scipctl() {\n";
    print_command(words, "\"${(@)words[2,CURRENT-1]}\"");
    print_cases(words, "compadd -- ", "");
    std::cout << "  esac\n  _files\n}\ncompdef _scipctl scipctl\n";
}

}  // namespace

void add_completion_command(CLI::App& program) {
    auto* const command = program.add_subcommand("completion", "print completions for a shell");
    const auto shell = std::make_shared<std::string>();
    command->add_option("SHELL", *shell, "bash or zsh")
        ->required()
        ->check(CLI::IsMember({"bash", "zsh"}));
    command->callback([&program, shell] {
        Words words;
        collect(program, "", "", words);
        words["/completion"].insert(0, "bash zsh ");
        // A running scipd knows them. In both shells this becomes words.
        words["/fault/start"].insert(0, "$(scipctl fault kinds --names 2>/dev/null) ");
        words["/scene/medium"].insert(0, "fog dust rain snow custom none ");
        *shell == "bash" ? print_bash(words) : print_zsh(words);
    });
    command->footer("Example:\n  source <(scipctl completion bash)");
}

}  // namespace scipd::tools
