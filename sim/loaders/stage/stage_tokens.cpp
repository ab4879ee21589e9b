// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/stage/stage_tokens.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "sim/loaders/file/allowed_folder.h"
#include "sim/loaders/file/load_error.h"
#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

using Kind = StageToken::Kind;

constexpr std::size_t deepest_stage_include = 16;
/// Enough for a world of a hundred thousand blocks.
constexpr std::size_t most_tokens = 4'000'000;

bool is_alpha(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

bool is_digit(char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

class Scanner {
  public:
    Scanner(StageTokens& tokens, const FindInclude& find) : tokens_(tokens), find_(find) {}

    void scan(const StageText& source, std::size_t depth) {
        const std::size_t file = tokens_.files.size();
        tokens_.files.push_back(source.file);
        Place place{file, 1, source.text, depth};
        while (!place.rest.empty())
            take(place);
    }

  private:
    struct Place {
        std::size_t file;
        int line;
        std::string_view rest;
        std::size_t depth;
    };

    void take(Place& at) {
        const char c = at.rest.front();
        constexpr std::string_view brackets = "()[]";
        constexpr std::array kinds{Kind::open, Kind::close, Kind::open_list, Kind::close_list};
        if (c == '\n') {
            ++at.line;
            at.rest.remove_prefix(1);
        } else if (std::isspace(static_cast<unsigned char>(c)) != 0) {
            at.rest.remove_prefix(1);
        } else if (c == '#') {
            at.rest.remove_prefix(std::min(at.rest.find('\n'), at.rest.size()));
        } else if (const auto bracket = brackets.find(c); bracket != brackets.npos) {
            add(at, kinds[bracket], 1);
        } else if (c == '"') {
            take_text(at);
        } else if (is_alpha(c) || c == '_') {
            take_word(at);
        } else if (is_digit(c) || c == '-' || c == '+' || c == '.') {
            add(at, Kind::number, length_of_number(at.rest));
        } else {
            refuse(at,
                   quote(at.rest.substr(0, 1)) + " means nothing to Stage; is it a Stage world?");
        }
    }

    void take_text(Place& at) {
        const auto end = at.rest.find_first_of("\"\n", 1);
        if (end == at.rest.npos || at.rest[end] == '\n') refuse(at, "a text has no closing quote");
        at.rest.remove_prefix(1);
        add(at, Kind::text, end - 1);
        at.rest.remove_prefix(1);
    }

    /// `point[3]` is one word.
    void take_word(Place& at) {
        std::size_t length = 1;
        while (length < at.rest.size() &&
               (is_alpha(at.rest[length]) || is_digit(at.rest[length]) || at.rest[length] == '_' ||
                at.rest[length] == '-' || at.rest[length] == '.')) {
            ++length;
        }
        std::size_t end = length + 1;
        while (end < at.rest.size() && is_digit(at.rest[end]))
            ++end;
        const bool has_index = length < at.rest.size() && at.rest[length] == '[' &&
                               end > length + 1 && end < at.rest.size() && at.rest[end] == ']';
        const bool includes = at.rest.substr(0, length) == "include";
        add(at, Kind::word, has_index ? end + 1 : length);
        if (includes) take_include(at);
    }

    void take_include(Place& at) {
        tokens_.all.pop_back();
        const auto begin = at.rest.find_first_not_of(" \t");
        if (begin == at.rest.npos || at.rest[begin] != '"') refuse(at, "include wants \"a file\"");
        at.rest.remove_prefix(begin);
        take_text(at);
        const std::string name = std::move(tokens_.all.back().text);
        tokens_.all.pop_back();
        if (at.depth == deepest_stage_include) {
            refuse(at, "includes nest deeper than " + std::to_string(deepest_stage_include) +
                           "; do they go in circles?");
        }
        const auto included = find_(name, tokens_.files[at.file]);
        if (included) return scan(*included, at.depth + 1);
        tokens_.warnings.push_back(place(at) + ": there is no " + quote(name) +
                                   " beside the world or this file" + or_in_no_folder() +
                                   "; left out");
    }

    static std::size_t length_of_number(std::string_view text) {
        std::size_t length = 1;
        while (length < text.size()) {
            const char c = text[length];
            const char before = text[length - 1];
            const bool is_sign = (c == '-' || c == '+') && (before == 'e' || before == 'E');
            if (!is_digit(c) && c != '.' && c != 'e' && c != 'E' && !is_sign) break;
            ++length;
        }
        return length;
    }

    void add(Place& at, Kind kind, std::size_t length) {
        if (tokens_.all.size() == most_tokens) refuse(at, "holds too many words for a world");
        tokens_.all.push_back({kind, std::string(at.rest.substr(0, length)), at.file, at.line});
        at.rest.remove_prefix(length);
    }

    [[nodiscard]] std::string place(const Place& at) const {
        return tokens_.files[at.file].string() + ':' + std::to_string(at.line);
    }
    [[noreturn]] void refuse(const Place& at, const std::string& why) const {
        throw LoadError({place(at) + ": " + why});
    }

    StageTokens& tokens_;
    const FindInclude& find_;
};

}  // namespace

StageTokens stage_tokens(const StageText& world, const FindInclude& find) {
    StageTokens tokens;
    Scanner{tokens, find}.scan(world, 0);
    return tokens;
}

}  // namespace scipd::sim
