// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/faults/message_lines.h"

namespace scipd::daemon {
namespace {

bool chosen(SumsOf of, std::size_t line, bool text) {
    if (line == 0) return false;  // the echo has none
    if (line == 1) return of == SumsOf::status || of == SumsOf::all;
    return of == SumsOf::all || of == (text ? SumsOf::text : SumsOf::data);
}

}  // namespace

std::vector<std::size_t> places_of_sums(std::string_view message, SumsOf of) {
    std::vector<std::size_t> places;
    std::size_t line = 0;
    for (std::size_t begin = 0; begin < message.size(); ++line) {
        const std::size_t end = message.find('\n', begin);
        if (end == std::string_view::npos || end == begin) break;
        // A line of text is KEY:VALUE;SUM. Data may have ';' too, but KEY: no character below '0'.
        const std::string_view content = message.substr(begin, end - begin);
        const bool text =
            content.size() > 2 && content[content.size() - 2] == ';' && content.find(':') == 4;
        // SCIP 1.1 has statuses of one character, and no sums.
        if (line == 1 && content.size() == 1) break;
        if (content.size() > 1 && chosen(of, line, text)) places.push_back(end - 1);
        begin = end + 1;
    }
    return places;
}

}  // namespace scipd::daemon
