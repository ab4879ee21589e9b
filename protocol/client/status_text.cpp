// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
#include "protocol/client/status_text.h"

#include <optional>
#include <string_view>

#include "protocol/command_table.h"
#include "protocol/words.h"

namespace scipd::protocol::client {
namespace {

/// Looks among all commands that any model knows. Null: none.
const Command* command_of(std::string_view echo) {
    const Command* found = nullptr;
    for (const Command& command : command_table()) {
        const bool longer = found == nullptr || command.code.size() > found->code.size();
        if (longer && echo.starts_with(command.code)) found = &command;
    }
    return found;
}

}  // namespace

std::string describe_status(const Message& message) {
    const auto status = Status::parse(message.status);
    const auto meaning = status ? status_words(command_of(message.echo), *status) : "";
    std::string text = "status " + message.status;
    if (!meaning.empty()) text.append(": ").append(meaning);
    return text;
}

std::string describe(const Damage& damage) {
    const std::string line = "line " + std::to_string(damage.line);
    switch (damage.kind) {
        case Damage::Kind::no_status:
            return "it has no status";
        case Damage::Kind::bad_status:
            return "its status is damaged";
        case Damage::Kind::bad_sum:
            return line + " does not match its checksum";
        case Damage::Kind::line_too_long:
            return line + " is too long";
        case Damage::Kind::too_long:
            return "it never ends";
    }
    return {};
}

}  // namespace scipd::protocol::client
