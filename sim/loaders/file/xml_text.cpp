// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/file/xml_text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "sim/loaders/file/mistaken_file.h"

namespace scipd::sim {
namespace {

struct Mark {
    std::string_view begins;
    std::string_view ends;
    bool is_text;
};

constexpr std::array<Mark, 3> marks{
    {{"<!--", "-->", false}, {"<?", "?>", false}, {"<![CDATA[", "]]>", true}}};

constexpr std::array<std::string_view, 4> latin_1{"iso-8859-1", "iso8859-1", "latin1", "latin-1"};

/// In small letters; empty if the declaration names none.
std::string declared_encoding(std::string_view text) {
    text = without_blank_start(text);
    if (!text.starts_with("<?xml")) return {};
    text = text.substr(0, text.find("?>"));
    const auto at = text.find("encoding");
    const auto begin = at == text.npos ? at : text.find_first_of("'\"", at);
    if (begin == text.npos) return {};
    const auto named = text.substr(begin + 1, text.find(text[begin], begin + 1) - begin - 1);
    std::string small{named};
    std::ranges::transform(small, small.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return small;
}

}  // namespace

std::string in_utf8(const std::string& text) {
    const std::string encoding = declared_encoding(text);
    if (std::ranges::find(latin_1, encoding) == latin_1.end()) return text;
    std::string utf8;
    utf8.reserve(text.size());
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x80U) {
            utf8.push_back(c);
        } else {
            utf8.push_back(static_cast<char>(0xC0U | (byte >> 6U)));
            utf8.push_back(static_cast<char>(0x80U | (byte & 0x3FU)));
        }
    }
    return utf8;
}

bool blank_comments(std::string& text) {
    bool any = false;
    const auto declaration = text.size() - without_blank_start(text).size();
    for (auto at = text.find('<'); at != text.npos; at = text.find('<', at)) {
        const auto rest = std::string_view{text}.substr(at);
        const auto mark = std::ranges::find_if(
            marks, [&](const Mark& known) { return rest.starts_with(known.begins); });
        if (mark == marks.end()) {
            ++at;
            continue;
        }
        const auto last = text.find(mark->ends, at + mark->begins.size());
        if (last == text.npos) break;  // who parses the text tells of it
        const auto end = last + mark->ends.size();
        const bool is_kept = mark->is_text || (at == declaration && rest.starts_with("<?"));
        if (!is_kept) {
            any = true;
            std::replace_if(
                text.begin() + static_cast<std::ptrdiff_t>(at),
                text.begin() + static_cast<std::ptrdiff_t>(end), [](char c) { return c != '\n'; },
                ' ');
        }
        at = end;
    }
    return any;
}

}  // namespace scipd::sim
