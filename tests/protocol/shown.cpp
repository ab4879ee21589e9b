// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tests/protocol/shown.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdio>

namespace scipd::protocol {

std::string shown(std::string_view bytes) {
    std::string text = "\"";
    for (const char c : bytes) {
        if (c >= ' ' && c <= '~' && c != '"' && c != '\\') {
            text += c;
        } else {
            char code[8];
            std::snprintf(code, sizeof code, "\\x%02X",
                          static_cast<unsigned>(static_cast<unsigned char>(c)));
            text += code;
        }
    }
    return text + "\"";
}

std::string milliseconds(Uptime time) {
    char text[32];
    std::snprintf(text, sizeof text, "%.15g ms",
                  std::chrono::duration<double, std::milli>(time).count());
    return text;
}

std::string test_name(const DeviceProfile& profile) {
    std::string name = profile.name + "_" + profile.release;
    const auto is_no_letter = [](unsigned char c) { return std::isalnum(c) == 0; };
    std::ranges::replace_if(name, is_no_letter, '_');
    return name;
}

}  // namespace scipd::protocol
