// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/client/decoder.h"

#include <algorithm>
#include <utility>

#include "protocol/checksum.h"

namespace scipd::protocol::client {
namespace {

/// VV, PP and II answer with lines of KEY:VALUE;SUM. The sum does not include the semicolon.
bool answers_in_entries(std::string_view echo) {
    const std::string_view code = echo.substr(0, 2);
    return code == "VV" || code == "PP" || code == "II";
}

/// The line without `tail` and its sum; nothing if the sum is wrong.
std::optional<std::string_view> without_sum(std::string_view line, std::string_view tail) {
    if (line.empty() || !line.substr(0, line.size() - 1).ends_with(tail)) return std::nullopt;
    const std::string_view text = line.substr(0, line.size() - 1 - tail.size());
    if (checksum(text) != line.back()) return std::nullopt;
    return text;
}

}  // namespace

std::optional<Message> Decoder::next(std::string_view& bytes) {
    while (!bytes.empty()) {
        const std::size_t end = std::min(bytes.find('\n'), bytes.size());
        const std::size_t room = max_line - line_.size();
        line_.append(bytes.substr(0, std::min(end, room)));
        if (end > room) damaged(Damage::Kind::line_too_long);

        const bool terminated = end < bytes.size();
        bytes.remove_prefix(terminated ? end + 1 : end);
        if (!terminated) break;
        if (!line_.empty()) {
            take_line();
        } else if (number_ > 1) {
            return finish();
        }
    }
    return std::nullopt;
}

void Decoder::take_line() {
    size_ += line_.size();
    if (size_ > max_message) {
        damaged(Damage::Kind::too_long);
    } else if (number_ == 1) {
        message_.echo = line_;
    } else if (number_ == 2) {
        take_status();
    } else {
        take_data();
    }
    line_.clear();
    ++number_;
}

void Decoder::take_status() {
    const auto code = without_sum(line_, "");
    if (line_.size() == 1) {
        message_.status = line_;
    } else if (line_.size() == 3 && code) {
        message_.status = *code;
    } else {
        damaged(Damage::Kind::bad_status);
    }
}

void Decoder::take_data() {
    const bool scip_1 = message_.status.size() == 1;
    if (scip_1) return message_.lines.push_back(line_);
    if (const auto text = without_sum(line_, answers_in_entries(message_.echo) ? ";" : "")) {
        message_.lines.emplace_back(*text);
    } else {
        damaged(Damage::Kind::bad_sum);
    }
}

void Decoder::damaged(Damage::Kind kind) {
    if (!message_.damage) message_.damage = Damage{kind, number_};
}

Message Decoder::finish() {
    if (number_ == 2) damaged(Damage::Kind::no_status);
    Message message = std::move(message_);
    reset();
    return message;
}

}  // namespace scipd::protocol::client
