// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/text/name.h"

#include <array>
#include <cstdint>
#include <cstdio>

#include "sim/fnv1a.h"
#include "sim/text/quote.h"

namespace scipd::sim {

std::string name_fault(std::string_view name) {
    if (name.empty()) return "must not be empty";
    if (name.size() > longest_name) {
        return "must be at most " + std::to_string(longest_name) + " bytes long, not " +
               std::to_string(name.size());
    }
    const bool has_control = name.find_first_of("\n\t") != name.npos || shown(name) != name;
    return has_control ? "must be UTF-8 without control characters" : "";
}

std::string short_name(std::string_view name) {
    if (name.size() <= longest_name) return std::string(name);
    std::array<char, 10> digits;
    std::snprintf(digits.data(), digits.size(), "~%08x", fnv1a<std::uint32_t>(name));
    const std::size_t room = longest_name - (digits.size() - 1);
    return std::string(name.substr(0, whole_characters(name, room))) + digits.data();
}

}  // namespace scipd::sim
