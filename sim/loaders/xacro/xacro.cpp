// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/xacro/xacro.h"

#include <algorithm>
#include <ranges>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "sim/loaders/file/confined.h"
#include "sim/loaders/file/load_error.h"
#include "sim/loaders/file/plain_file.h"
#include "sim/loaders/file/xml_tree.h"
#include "sim/loaders/sdf/sdf.h"
#include "sim/text/quote.h"
#include "sim/text/text_number.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t most_bytes = std::uintmax_t{64} << 20U;  // of a file in xacro
/// Enough for a Python program that reads some hundred files.
const Confines confines{.processor_time = std::chrono::seconds(60),
                        .memory_bytes = std::size_t{4} << 30U,
                        .wall_time = std::chrono::minutes(1)};

/// The text of an error, without its line end.
std::string words_of(const std::runtime_error& error) {
    std::string words = shown(error.what());
    return words.substr(0, words.find_last_not_of('\n') + 1);
}

constexpr auto how_to_set =
    "--xacro NAME:=VALUE, or xacro: {NAME: VALUE} in the configuration, sets it";

/// The advice for an argument that xacro misses; empty for any other error.
std::string advice_for(const std::string& error) {
    // xacro says so of $(arg NAME) where no <xacro:arg> gives NAME a default.
    return error.find("Undefined substitution argument") == error.npos
               ? ""
               : std::string("; ") + how_to_set;
}

std::vector<std::string> command_for(const fs::path& file, const XacroArguments& arguments) {
    std::vector<std::string> command{"xacro", file.string()};
    for (const auto& [name, value] : arguments)
        command.push_back(name + ":=" + value);
    return command;
}

/// Adds the arguments that a file declares, <xacro:arg name="NAME">, or uses, $(arg NAME).
void add_arguments_of(const fs::path& file, std::set<std::string>& names) {
    const std::string text = read_file(file, most_bytes, "name a robot written in xacro");
    tinyxml2::XMLDocument document;
    if (document.Parse(text.data(), text.size()) == tinyxml2::XML_SUCCESS) {
        for_each(*document.RootElement(), [&](const tinyxml2::XMLElement& element) {
            if (std::string_view(element.Name()).ends_with(":arg"))
                names.insert(attribute(element, "name"));
        });
    }
    constexpr std::string_view use = "$(arg ";
    for (auto at = text.find(use); at != text.npos; at = text.find(use, at)) {
        at += use.size();
        names.insert(std::string(trimmed(text.substr(at, text.find(')', at) - at))));
    }
}

std::string expanded(const fs::path& file, const XacroArguments& arguments) {
    const auto refuse = [&](const std::string& why) {
        throw LoadError({file.string() + ": " + why});
    };
    if (const auto plain = check_plain_file(file); !plain) {
        refuse(plain.error().why + "; name a robot written in xacro");
    }
    try {
        if (const auto text = output_of(confines, command_for(file, arguments))) return *text;
    } catch (const std::runtime_error& error) {
        const std::string words = words_of(error);
        refuse("xacro fails: " + words + advice_for(words));
    }
    const std::string name = file.filename().string();
    const std::string robot = file.stem().replace_extension(".urdf").string();
    refuse(
        "is written in xacro, which is not installed here: install it (pip install xacro, or "
        "the package ros-...-xacro), or write `xacro " +
        name + " > " + robot + "` where it is, and name that file");
    return {};
}

}  // namespace

LoadedScene load_xacro(const fs::path& given, const SdfOptions& options) {
    const auto file = fs::absolute(given).lexically_normal();
    const std::string text = expanded(file, options.xacro);
    // A truncated document is reported by the XML parser.
    const bool is_robot = text.find("<robot") != text.npos && text.find('>') != text.npos;
    if (is_robot && text.find("<link") == text.npos) {
        throw LoadError({file.string() +
                         ": has no link once xacro has expanded it: it may only define macros, so "
                         "name the file that calls them, or depend on an argument; " +
                         how_to_set});
    }
    return load_sdf_text(text, file.string() + " (as xacro prints it)", file.parent_path(),
                         options);
}

std::vector<std::string> ignored_arguments(const fs::path& given, const XacroArguments& arguments) {
    const auto file = fs::absolute(given).lexically_normal();
    std::set<std::string> names;
    std::vector<std::string> warnings;
    try {
        add_arguments_of(file, names);
        const auto is_ignored = [&](const auto& one) { return !names.contains(one.first); };
        if (std::ranges::none_of(arguments, is_ignored)) return {};
        auto command = command_for(file, arguments);
        command.emplace_back("--deps");
        // Blanks separate the paths of included files, and may be part of a path.
        std::istringstream included(output_of(confines, command).value_or(""));
        std::string path;
        for (std::string word; included >> word;) {
            path += (path.empty() ? "" : " ") + word;
            if (check_plain_file(path)) add_arguments_of(std::exchange(path, {}), names);
        }
        if (!path.empty()) return {};
        for (const auto& [name, value] : arguments | std::views::filter(is_ignored))
            warnings.push_back(file.string() + ": has no xacro argument " + quote(name) +
                               "; it has " + (names.empty() ? "none" : listed(names)));
    } catch (const std::runtime_error&) {  // an xacro without --deps
    }
    return warnings;
}

}  // namespace scipd::sim
