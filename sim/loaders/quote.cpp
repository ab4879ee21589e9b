// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/quote.h"

namespace scipd::sim {

std::string printable(std::string_view text, std::size_t limit) {
    const bool whole = text.size() <= limit;
    std::string out{text.substr(0, limit)};
    for (char& c : out) {
        if (c < ' ' || c > '~') c = '?';
    }
    return whole ? out : out + "...";
}

std::string quote(std::string_view text) {
    std::string quoted = printable(text, 40);
    quoted.insert(quoted.begin(), '\'');
    quoted.push_back('\'');
    return quoted;
}

}  // namespace scipd::sim
