// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/text/column_title.h"

#include <algorithm>
#include <cctype>
#include <optional>

#include "sim/text/text_number.h"

namespace scipd::sim {
namespace {

bool is_letter(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

bool is_digit(char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

/// Where "e-16" begins in "range_2.2e-16", if its digits begin at `digits`.
std::optional<std::size_t> begin_of_exponent(std::string_view name, std::size_t digits) {
    if (digits < 3 || digits == name.size()) return std::nullopt;
    const bool has_sign = name[digits - 1] == '-' || name[digits - 1] == '+';
    if (!has_sign || name[digits - 2] != 'e' || !is_digit(name[digits - 3])) return std::nullopt;
    return digits - 2;
}

/// Where the number begins that the name ends in; the name's size if there is none. A minus behind
/// a letter or a digit is a dash.
std::size_t begin_of_number(std::string_view name) {
    constexpr std::string_view in_number = "0123456789.";
    std::size_t begin = name.find_last_not_of(in_number);
    begin = begin == name.npos ? 0 : begin + 1;
    while (begin < name.size() && name[begin] == '.')
        ++begin;
    if (const auto exponent = begin_of_exponent(name, begin))
        return begin_of_number(name.substr(0, *exponent));
    const bool signed_here = begin < name.size() && begin > 0 && name[begin - 1] == '-';
    if (!signed_here) return begin;
    const bool dash = begin > 1 && std::isalnum(static_cast<unsigned char>(name[begin - 2])) != 0;
    return dash ? begin : begin - 1;
}

}  // namespace

ColumnTitle ColumnTitle::of(std::string_view name) {
    std::string text(name);
    std::erase(text, '"');
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
    const std::size_t end = text.find_last_not_of("])} ");
    if (end != text.npos) text.erase(end + 1);
    const std::size_t begin = begin_of_number(text);
    const auto number = parse_number(std::string_view(text).substr(begin));
    return {number ? text.substr(0, begin) : text, number};
}

bool ColumnTitle::has_word(std::string_view word) const {
    for (std::size_t at = stem.find(word); at != stem.npos; at = stem.find(word, at + 1)) {
        const std::size_t end = at + word.size();
        if ((at == 0 || !is_letter(stem[at - 1])) && (end == stem.size() || !is_letter(stem[end])))
            return true;
    }
    return false;
}

}  // namespace scipd::sim
