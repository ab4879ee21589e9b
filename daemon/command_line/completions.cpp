// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/command_line/completions.h"

#include <algorithm>
#include <cctype>
#include <sstream>

#include <CLI/CLI.hpp>

namespace scipd::daemon {
namespace {

struct Option {
    std::string name;
    std::string short_name;  ///< empty: it has none
    std::string what;
    bool takes_value = false;
    std::string values;  ///< empty: any
};

/// A command, or the program itself.
struct Place {
    std::string path;  ///< /pose/set; empty for the program
    std::string arguments;
    bool takes_file = false;  ///< as an argument
    std::vector<const CLI::App*> commands;
    std::vector<Option> options;
};

/// The values that an option names in its help, as {a,b} or as a|b: "a b". Names in capitals stand
/// for what the user fills in. None where a file may stand as well: the shell offers files then.
std::string values_of(const CLI::Option& option) {
    std::string type = option.get_type_name();
    if (type.find("PATH(existing)") != type.npos) return {};
    const auto begin = type.find('{');
    if (begin != type.npos) {
        type = type.substr(begin + 1, type.find('}') - begin - 1);
    } else if (type.find('|') == type.npos || std::any_of(type.begin(), type.end(), ::isupper)) {
        return {};
    }
    const auto separates = [](char c) { return c == ',' || c == '|'; };
    std::ranges::replace_if(type, separates, ' ');
    return type;
}

bool stands_for_file(const CLI::Option& option) {
    const std::string type = option.get_type_name();
    return type.find("FILE") != type.npos || type.find("PATH") != type.npos;
}

std::string looked_up(const MoreWords& more, const std::string& place, const std::string& other) {
    const auto found = more.find(place);
    return found == more.end() ? other : found->second;
}

Place place_of(const CLI::App& app, const std::string& path, const MoreWords& more) {
    Place place{.path = path};
    place.commands = app.get_subcommands([](const CLI::App*) { return true; });
    for (const CLI::Option* option : app.get_options()) {
        const std::string values = values_of(*option);
        if (option->get_positional()) {
            place.arguments += values.empty() ? "" : values + " ";
            place.takes_file = place.takes_file || stands_for_file(*option);
            continue;
        }
        const std::string& name = option->get_lnames().front();
        const auto& short_names = option->get_snames();
        place.options.push_back({.name = name,
                                 .short_name = short_names.empty() ? "" : short_names.front(),
                                 .what = option->get_description(),
                                 .takes_value = option->get_items_expected_max() > 0,
                                 .values = looked_up(more, path + "/--" + name, values)});
    }
    place.arguments = looked_up(more, path, place.arguments);
    return place;
}

/// `inherited` are the options of the enclosing commands, which may follow as well.
void collect(const CLI::App& app, const std::string& path, const std::vector<Option>& inherited,
             const MoreWords& more, std::vector<Place>& all) {
    Place place = place_of(app, path, more);
    std::vector<Option> passed_on = inherited;
    for (const Option& option : place.options)
        if (option.name != "help" && option.name != "version") passed_on.push_back(option);
    place.options.insert(place.options.end(), inherited.begin(), inherited.end());
    all.push_back(place);
    for (const CLI::App* command : place.commands) {
        collect(*command, path + "/" + command->get_name(),
                command->get_fallthrough() ? passed_on : std::vector<Option>{}, more, all);
    }
}

/// The paths of all commands, with this between them.
std::string paths(const std::vector<Place>& places, const char* between) {
    std::string list;
    for (const Place& place : places)
        if (!place.path.empty()) list += (list.empty() ? "" : between) + place.path;
    return list;
}

std::string words_of(const Place& place) {
    std::string words = place.arguments;
    for (const CLI::App* command : place.commands)
        words += command->get_name() + " ";
    for (const Option& option : place.options)
        words += "--" + option.name + " ";
    words.pop_back();
    return words;
}

/// What bash and zsh share: code that puts the words that may follow into $choices. `typed` are the
/// words before the cursor, and $last is the last of them, or the option whose value follows a =.
void print_choices(const std::vector<Place>& places, const char* typed, std::ostream& out) {
    out << "  local command='' word choices=''\n";
    if (places.size() > 1) {
        out << "  for word in " << typed << "; do\n    case \"$command/$word\" in\n      "
            << paths(places, "|") << ") command=\"$command/$word\" ;;\n    esac\n  done\n";
    }
    out << "  case \"$command\" in\n";
    for (const Place& place : places)
        out << "    \"" << place.path << "\") choices=\"" << words_of(place) << "\" ;;\n";
    out << "  esac\n  case \"$command/$last\" in\n";
    for (const Place& place : places) {
        for (const Option& option : place.options) {
            if (!option.takes_value) continue;
            out << "    " << place.path << "/--" << option.name;
            if (!option.short_name.empty()) out << "|" << place.path << "/-" << option.short_name;
            out << ") choices=\"" << option.values << "\" ;;\n";
        }
    }
    out << "  esac\n";
}

/// Its words break at =, which is one of them. It offers files only where these completions offer
/// nothing, so options must wait for their - where a file may stand.
void print_bash(const std::string& program, const std::vector<Place>& places, std::ostream& out) {
    out << "# Completions of " << program << " for bash.\n_" << program << "() {\n"
        << "  local current=\"${COMP_WORDS[COMP_CWORD]}\" last=\"${COMP_WORDS[COMP_CWORD-1]}\"\n"
        << "  if [[ $current == = ]]; then current=''\n"
        << "  elif [[ $last == = ]]; then last=\"${COMP_WORDS[COMP_CWORD-2]}\"; fi\n";
    print_choices(places, "\"${COMP_WORDS[@]:1:COMP_CWORD-1}\"", out);
    std::string files;
    for (const Place& place : places)
        if (place.takes_file && place.arguments.empty())
            files += (files.empty() ? "" : "|") + place.path;
    if (!files.empty())
        out << "  if [[ $choices == *--* && $current != -* && \"$command\" == @(" << files
            << ") ]]; then choices=''; fi\n";
    out << "  COMPREPLY=($(compgen -W \"$choices\" -- \"$current\"))\n"
        << "}\ncomplete -o default -F _" << program << " " << program << "\n";
}

/// zsh runs the file itself to complete where it finds it in a folder of its own, and its function
/// where somebody has read the file.
void print_zsh(const std::string& program, const std::vector<Place>& places, std::ostream& out) {
    out << "#compdef " << program << "\n# Completions of " << program << " for zsh.\n_" << program
        << "() {\n";
    out << "  local last=${words[CURRENT-1]}\n"
        << "  if [[ ${words[CURRENT]} == --*=* ]]; then last=${words[CURRENT]%%=*}; compset -P "
           "'*='; fi\n";
    print_choices(places, "\"${(@)words[2,CURRENT-1]}\"", out);
    out << "  compadd -- ${=choices}\n  _files\n}\n"
        << "if [[ $funcstack[1] == _" << program << " ]]; then _" << program
        << " \"$@\"; else compdef _" << program << " " << program << "; fi\n";
}

std::string quoted_for_fish(std::string text) {
    for (std::size_t at = 0; (at = text.find_first_of("'\\", at)) != text.npos; at += 2)
        text.insert(at, 1, '\\');
    return "'" + text + "'";
}

/// fish runs what stands in (..), not in $(..).
std::string run_by_fish(std::string words) {
    for (std::size_t at = 0; (at = words.find("$(", at)) != words.npos;)
        words.erase(at, 1);
    return quoted_for_fish(words);
}

void print_fish_place(const std::string& program, const Place& place, std::ostream& out) {
    const std::string begin =
        "complete -c " + program + " -n '__" + program + "_in \"" + place.path + "\"' ";
    // Without commands or words of its own there may be a file.
    if (!place.commands.empty()) out << begin << "-f\n";
    if (!place.arguments.empty()) out << begin << "-f -a " << run_by_fish(place.arguments) << "\n";
    for (const CLI::App* command : place.commands) {
        out << begin << "-a " << command->get_name() << " -d "
            << quoted_for_fish(command->get_description()) << "\n";
    }
    for (const Option& option : place.options) {
        out << begin << "-l " << option.name;
        if (!option.short_name.empty()) out << " -s " << option.short_name;
        if (!option.values.empty()) out << " -x -a " << run_by_fish(option.values);
        if (option.values.empty() && option.takes_value) out << " -r -F";
        out << " -d " << quoted_for_fish(option.what) << "\n";
    }
}

void print_fish(const std::string& program, const std::vector<Place>& places, std::ostream& out) {
    out << "# Completions of " << program << " for fish.\nfunction __" << program
        << "_in\n  set -l command ''\n";
    if (places.size() > 1) {
        out << "  for word in (commandline -opc)[2..]\n    switch \"$command/$word\"\n      case "
            << paths(places, " ") << "\n        set command \"$command/$word\"\n    end\n  end\n";
    }
    out << "  test \"$command\" = \"$argv[1]\"\nend\n";
    for (const Place& place : places)
        print_fish_place(program, place, out);
}

}  // namespace

const std::vector<std::string>& completion_shells() {
    static const std::vector<std::string> shells{"bash", "zsh", "fish"};
    return shells;
}

std::string completions(const CLI::App& program, const std::string& shell, const MoreWords& more) {
    std::vector<Place> places;
    collect(program, "", {}, more, places);
    const auto print = shell == "bash" ? print_bash : shell == "zsh" ? print_zsh : print_fish;
    std::ostringstream out;
    print(program.get_name(), places, out);
    return out.str();
}

}  // namespace scipd::daemon
