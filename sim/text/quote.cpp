// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/text/quote.h"

#include <array>
#include <optional>

namespace scipd::sim {
namespace {

struct Character {
    char32_t code;
    std::size_t bytes;
};

/// The first character of a text that is not empty; nothing if it does not begin with UTF-8.
std::optional<Character> first_of(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char lead = byte(0);
    if (lead < 0x80) return Character{lead, 1};
    const std::size_t bytes = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
    if (lead < 0xC2 || lead > 0xF4 || text.size() < bytes) return std::nullopt;
    char32_t code = lead & (0x7FU >> bytes);
    for (std::size_t i = 1; i < bytes; ++i) {
        if ((byte(i) & 0xC0U) != 0x80) return std::nullopt;
        code = (code << 6U) | (byte(i) & 0x3FU);
    }
    constexpr std::array<char32_t, 5> least{0, 0, 0x80, 0x800, 0x10000};
    const bool is_surrogate = code >= 0xD800 && code <= 0xDFFF;
    if (code < least[bytes] || code > 0x10FFFF || is_surrogate) return std::nullopt;
    return Character{code, bytes};
}

/// take(bytes, code) of each character; without a code of each byte that begins none.
template <class Take>
void each_character(std::string_view text, Take take) {
    while (!text.empty()) {
        const auto character = first_of(text);
        const std::string_view bytes = text.substr(0, character ? character->bytes : 1);
        take(bytes, character ? std::optional(character->code) : std::nullopt);
        text.remove_prefix(bytes.size());
    }
}

/// Control characters except tab and line feed, and characters that end lines, change the reading
/// direction or are invisible.
bool does_harm(char32_t code) {
    struct Range {
        char32_t first;
        char32_t last;
    };
    constexpr std::array<Range, 10> ranges{{{0x00, 0x08},
                                            {0x0B, 0x1F},
                                            {0x7F, 0x9F},
                                            {0x61C, 0x61C},
                                            {0x200B, 0x200F},
                                            {0x2028, 0x202E},
                                            {0x2060, 0x206F},
                                            {0xFEFF, 0xFEFF},
                                            {0xFFF9, 0xFFFB},
                                            {0xE0000, 0xE007F}}};
    for (const auto& [first, last] : ranges) {
        if (code >= first && code <= last) return true;
    }
    return false;
}

void append_escaped(std::string& text, std::string_view bytes) {
    constexpr std::string_view digits = "0123456789abcdef";
    for (const char c : bytes) {
        const auto byte = static_cast<unsigned char>(c);
        text.append({'\\', 'x', digits[byte >> 4U], digits[byte & 0xFU]});
    }
}

}  // namespace

std::string printable(std::string_view text, std::size_t limit) {
    const std::size_t whole = whole_characters(text, limit);
    std::string out;
    each_character(text.substr(0, whole), [&](std::string_view bytes, auto code) {
        const bool stays = code && *code >= ' ' && !does_harm(*code);
        out += stays ? std::string{bytes} : std::string(bytes.size(), '?');
    });
    return whole == text.size() ? out : out + "...";
}

std::string quote(std::string_view text, std::size_t limit) {
    std::string quoted = printable(text, limit);
    quoted.insert(quoted.begin(), '\'');
    quoted.push_back('\'');
    return quoted;
}

std::string shown(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    each_character(text, [&](std::string_view bytes, auto code) {
        if (code && !does_harm(*code)) {
            out += bytes;
        } else {
            append_escaped(out, bytes);
        }
    });
    return out;
}

std::size_t whole_characters(std::string_view text, std::size_t most) {
    std::size_t whole = 0;
    while (whole < text.size()) {
        const auto character = first_of(text.substr(whole));
        const std::size_t end = whole + (character ? character->bytes : 1);
        if (end > most) break;
        whole = end;
    }
    return whole;
}

}  // namespace scipd::sim
