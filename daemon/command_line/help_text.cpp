// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/command_line/help_text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <memory>
#include <set>
#include <string>
#include <string_view>

#include <CLI/CLI.hpp>

namespace scipd::daemon {
namespace {

constexpr std::size_t widest_line = 100;

/// What CLI11 calls the value of an option, in two: it appends what each check says of itself, with
/// colons between them. Colons are also part of words such as ADDR:PORT.
struct ValueType {
    std::string word;
    std::string check;
};

bool is_check(std::string_view text) {
    if (text.empty()) return false;
    const auto first = static_cast<unsigned char>(text.front());
    return std::isdigit(first) != 0 || text.front() == '-' || text.front() == '{' ||
           text.front() == '(' || text.starts_with("FILE") || text.starts_with("PATH");
}

ValueType type_of(const CLI::Option& option) {
    const std::string type = option.get_type_name();
    for (auto colon = type.find(':'); colon != type.npos; colon = type.find(':', colon + 1)) {
        if (is_check(std::string_view{type}.substr(colon + 1)))
            return {type.substr(0, colon), type.substr(colon + 1)};
    }
    return {type, {}};
}

/// "auto|embree" for "{auto,embree}"
std::string choices_of(std::string braces) {
    braces = braces.substr(1, braces.find('}') - 1);
    std::ranges::replace(braces, ',', '|');
    return braces;
}

/// The word for its value: FILE, N, ADDR:PORT, or what it can be.
std::string value_word(const CLI::Option& option) {
    if (option.get_type_size() == 0) return {};
    auto [word, check] = type_of(option);
    if (check.starts_with('{')) return choices_of(check);
    if (check.starts_with("PATH") || check.starts_with('(')) return "FILE";
    if (check.starts_with("FILE")) return check.substr(0, check.find(':'));
    constexpr std::array numbers{"INT", "UINT", "FLOAT"};
    return std::ranges::find(numbers, word) == numbers.end() ? word : "N";
}

/// The bounds of a number, "1 to 99".
std::string bounds_of(const CLI::Option& option) {
    const std::string check = type_of(option).check;
    const bool numbers =
        !check.empty() &&
        (std::isdigit(static_cast<unsigned char>(check[0])) != 0 || check.front() == '-');
    return numbers ? check : "";
}

/// "; not with --mount"
std::string listed(const char* begin, const std::set<CLI::Option*>& options) {
    std::set<std::string> names;
    for (const CLI::Option* option : options)
        names.insert(option->get_name());
    std::string text;
    for (const std::string& name : names)
        text += (text.empty() ? begin : ", ") + name;
    return text;
}

/// Words that do not fit go to the next line.
std::string wrapped(const std::string& text, std::size_t width) {
    std::string lines;
    std::size_t column = 0;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find(' ', at), text.size());
        const std::string word = text.substr(at, end - at);
        const bool fits = column + 1 + word.size() <= width;
        if (column > 0) lines += fits ? " " : "\n";
        column = (column > 0 && fits ? column + 1 : 0) + word.size();
        lines += word;
        at = end + 1;
    }
    return lines;
}

class HelpFormatter : public CLI::Formatter {
  public:
    std::string make_option(const CLI::Option* option, bool is_positional) const override {
        const std::string name = is_positional
                                     ? shown(*option)
                                     : make_option_name(option, false) + make_option_opts(option);
        return entry(name, make_option_desc(option));
    }

    std::string make_option_usage(const CLI::Option* option) const override {
        if (option->get_group().empty()) return {};  // hidden
        const bool may_repeat = option->get_expected_max() > 1 && option->get_option_text().empty();
        const std::string text = shown(*option) + (may_repeat ? "..." : "");
        return option->get_required() ? text : "[" + text + "]";
    }

    std::string make_option_opts(const CLI::Option* option) const override {
        const std::string& said = option->get_option_text();
        const std::string word = said.empty() ? value_word(*option) : said;
        return word.empty() ? "" : " " + word;
    }

    std::string make_option_desc(const CLI::Option* option) const override {
        std::string text = option->get_description();
        if (const std::string bounds = bounds_of(*option); !bounds.empty())
            text.insert(std::min(text.find("; default:"), text.size()), ", " + bounds);
        const bool must = option->get_required() && !option->get_positional();
        if (must) text += " (required)";
        text +=
            listed("; with ", option->get_needs()) + listed("; not with ", option->get_excludes());
        const std::string& usual = option->get_default_str();
        if (usual.empty()) return text;
        // Where an option may stand without a value, the library takes the default for that.
        const bool may_stand_alone = option->get_items_expected_min() == 0;
        return text + (may_stand_alone ? "; without a value: " : "; default: ") + usual;
    }

    std::string make_subcommand(const CLI::App* command) const override {
        return entry(command->get_name(), command->get_description());
    }

  private:
    /// CLI11 2.4 takes no blank in the name of an argument, so a text says how it is shown.
    [[nodiscard]] static std::string shown(const CLI::Option& argument) {
        const std::string& said = argument.get_option_text();
        return said.empty() ? argument.get_single_name() : said;
    }

    [[nodiscard]] std::string entry(const std::string& name, const std::string& what) const {
        std::ostringstream out;
        CLI::detail::format_help(out, name, wrapped(what, widest_line - get_column_width()),
                                 get_column_width());
        return out.str();
    }
};

void use(CLI::App& app, const std::shared_ptr<HelpFormatter>& formatter) {
    app.formatter(formatter);
    app.get_help_ptr()->description("print this help message and exit");
    for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        use(*command, formatter);
}

}  // namespace

void use_our_help(CLI::App& program) {
    use(program, std::make_shared<HelpFormatter>());
}

}  // namespace scipd::daemon
