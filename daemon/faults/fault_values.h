// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Values that several kinds of faults have, and how they are read. Any thread; nothing shared.
#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <utility>

#include "daemon/config/members.h"
#include "protocol/action.h"
#include "sim/expected.h"
#include "sim/text/quote.h"

namespace scipd::daemon {

/// A word of a table {{word, value}, ..}.
template <const auto& table>
auto parse_word(std::string_view text) -> sim::Expected<decltype(table[0].second)> {
    std::string words;
    for (const auto& [word, value] : table) {
        if (text == word) return value;
        words.append(words.empty() ? "" : ", ").append(word);
    }
    return sim::refuse("must be one of " + words + ", not " + sim::quote(text));
}

/// The code of a command, or the letter of one of SCIP 1.1.
sim::Expected<std::string> parse_code(std::string_view text);

/// Which messages of a scanner.
enum class MessageChoice { all, scans, replies };
inline constexpr std::pair<std::string_view, MessageChoice> message_choices[] = {
    {"all", MessageChoice::all},
    {"scans", MessageChoice::scans},
    {"replies", MessageChoice::replies}};

inline bool chooses(MessageChoice choice, const protocol::Send& message) {
    const bool scan = message.kind == protocol::Send::Kind::scan;
    return choice == MessageChoice::all || (choice == MessageChoice::scans) == scan;
}

/// For an effect without members of its own.
struct NoMembers {};
inline constexpr std::array<Member<NoMembers>, 0> no_members{};

}  // namespace scipd::daemon
