// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The first byte says how to cut the rest into pieces. However they are cut, the lines must be
// those of a plain split.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/line_reader.h"

namespace {

using scipd::protocol::Line;
using scipd::protocol::LineReader;

void demand(bool fact) {
    if (!fact) std::abort();
}

// The rules of the plain split: CR and LF end a line, empty lines do not count, lines that are too
// long are cut, NUL does not begin a line.
std::vector<Line> plain_split(std::string_view bytes) {
    std::vector<Line> lines;
    std::string text;
    for (const char c : bytes) {
        if (c == '\0' && text.empty()) continue;
        if (c != '\n' && c != '\r') {
            text += c;
        } else if (!text.empty()) {
            const bool overlong = text.size() > LineReader::max_length;
            lines.push_back({text.substr(0, LineReader::max_length), overlong});
            text.clear();
        }
    }
    return lines;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::size_t piece = 1 + data[0];
    const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
    const std::vector<Line> expected = plain_split(bytes);

    LineReader reader;
    std::size_t count = 0;
    for (std::size_t begin = 0; begin < bytes.size(); begin += piece) {
        std::string_view part = bytes.substr(begin, piece);
        while (const auto line = reader.next(part)) {
            demand(count < expected.size());
            demand(line->text == expected[count].text);
            demand(line->overlong == expected[count].overlong);
            ++count;
        }
        demand(part.empty());
    }
    demand(count == expected.size());
    return 0;
}
