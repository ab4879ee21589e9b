// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <string>

namespace scipd::tools {

/// The text as HTML and SVG have it. Control characters, which XML forbids, are blanks; lines stay.
[[nodiscard]] inline std::string in_markup(const std::string& text) {
    std::string escaped;
    for (const char letter : text) {
        switch (letter) {
            case '&':
                escaped += "&amp;";
                break;
            case '<':
                escaped += "&lt;";
                break;
            case '>':
                escaped += "&gt;";
                break;
            case '"':
                escaped += "&quot;";
                break;
            default:
                escaped +=
                    static_cast<unsigned char>(letter) < ' ' && letter != '\n' ? ' ' : letter;
        }
    }
    return escaped;
}

}  // namespace scipd::tools
