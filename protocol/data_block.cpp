// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/data_block.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "protocol/checksum.h"

namespace scipd::protocol {
namespace {

// 64 values of w characters fill w lines exactly, so the block is made in such pieces on the stack:
// every loop below has a length that the compiler knows and turns into vector instructions.
constexpr std::size_t piece_values = data_line_length;

// The w characters of a value as the low bytes of a word, ready to be stored in one go.
template <int width>
std::uint32_t characters_of(std::uint32_t value) {
    std::uint32_t characters = 0;
    for (int i = 0; i < width; ++i) {
        characters |= ((value >> (6 * (width - 1 - i)) & 0x3FU) + '0') << (8 * i);
    }
    return characters;
}

template <int width>
void encode_piece(const std::uint32_t* values, char* characters) {
    static_assert(std::endian::native == std::endian::little,
                  "the first character is the lowest byte");
    std::array<std::uint32_t, piece_values> words;
    for (std::size_t i = 0; i < piece_values; ++i)
        words[i] = characters_of<width>(values[i]);
    // Each store writes a word and is overwritten from its w-th byte on by the next one.
    for (std::size_t i = 0; i < piece_values; ++i)
        std::memcpy(characters + width * i, &words[i], sizeof(words[i]));
}

// Only the low six bits of the sum count, so it may wrap at eight.
char line_sum(const char* line, std::size_t length) {
    std::uint8_t sum = 0;
    for (std::size_t i = 0; i < length; ++i)
        sum = static_cast<std::uint8_t>(sum + static_cast<std::uint8_t>(line[i]));
    return static_cast<char>((sum & 0x3FU) + '0');
}

char* write_line(char* out, const char* characters, std::size_t length) {
    std::memcpy(out, characters, length);
    out[length] = line_sum(characters, length);
    out[length + 1] = '\n';
    return out + length + 2;
}

template <int width>
void write_block(char* out, std::span<const std::uint32_t> values) {
    std::array<char, width * piece_values + sizeof(std::uint32_t)> characters;
    for (; values.size() >= piece_values; values = values.subspan(piece_values)) {
        encode_piece<width>(values.data(), characters.data());
        for (int line = 0; line < width; ++line) {
            out = write_line(out, characters.data() + line * data_line_length, data_line_length);
        }
    }
    std::array<std::uint32_t, piece_values> rest{};
    std::copy(values.begin(), values.end(), rest.begin());
    encode_piece<width>(rest.data(), characters.data());
    const std::size_t total = values.size() * width;
    for (std::size_t begin = 0; begin < total; begin += data_line_length) {
        out = write_line(out, characters.data() + begin, std::min(data_line_length, total - begin));
    }
}

}  // namespace

void append_data_block(std::string& message, std::span<const std::uint32_t> values, int width) {
    const std::size_t begin = message.size();
    message.resize(begin + data_block_size(values.size(), width));
    if (width == 2) {
        write_block<2>(message.data() + begin, values);
    } else {
        write_block<3>(message.data() + begin, values);
    }
}

void append_data_block(std::string& message, std::string_view characters) {
    while (!characters.empty()) {
        const std::string_view line = characters.substr(0, data_line_length);
        message.append(line).push_back(checksum(line));
        message.push_back('\n');
        characters.remove_prefix(line.size());
    }
}

}  // namespace scipd::protocol
