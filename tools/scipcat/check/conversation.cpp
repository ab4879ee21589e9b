// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/check/conversation.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "protocol/client/error.h"

namespace scipd::tools::checks {
namespace {

using std::chrono::milliseconds;

constexpr std::string_view end_of_message = "\n\n";
/// A peer that sends as much without the end of a message is no scanner.
constexpr std::size_t most_unread = std::size_t{1} << 20U;

void keep(std::string& transcript, std::string_view bytes) {
    constexpr std::size_t most = std::size_t{1} << 16U;
    transcript.append(bytes.substr(0, most - std::min(most, transcript.size())));
}

}  // namespace

Conversation::Conversation(Place place) : place_(std::move(place)) {
    reconnect();
}

void Conversation::reconnect() {
    hang_up();
    transport_ = open_target(place_.target, place_.options);
    transport_->interrupt_on_signals();
}

void Conversation::hang_up() {
    transport_.reset();
    unread_.clear();
}

void Conversation::send(std::string_view bytes) {
    if (!transport_) reconnect();
    keep(sent_, bytes);
    transport_->write(bytes);
}

std::optional<std::string> Conversation::message() {
    return message(place_.patience);
}

std::optional<std::string> Conversation::message(milliseconds patience) {
    for (;;) {
        const std::size_t end = unread_.find(end_of_message);
        if (end != std::string::npos) {
            std::string message = unread_.substr(0, end + end_of_message.size());
            unread_.erase(0, message.size());
            return message;
        }
        if (unread_.size() > most_unread || !read(patience)) return std::nullopt;
    }
}

std::string Conversation::listen(milliseconds quiet) {
    const auto end = Clock::now() + quiet + std::chrono::seconds(1);
    while (unread_.size() <= most_unread && Clock::now() < end && read(quiet)) {
    }
    return std::exchange(unread_, {});
}

bool Conversation::quiet_for(milliseconds time) {
    return unread_.empty() && !read(time);
}

bool Conversation::ends_within(milliseconds time) {
    const auto end = Clock::now() + time;
    try {
        for (auto now = Clock::now(); now < end; now = Clock::now())
            read(std::chrono::ceil<milliseconds>(end - now));
        return false;
    } catch (const protocol::client::Error&) {  // it is gone, which is what was asked
        return true;
    }
}

void Conversation::begin() {
    sent_.clear();
    got_.clear();
}

std::string_view Conversation::last_line_sent() const {
    std::string_view rest = sent_;
    rest = rest.substr(0, rest.find_last_not_of("\r\n") + 1);
    return rest.substr(rest.find_last_of("\r\n") + 1);
}

/// False: nothing has come in time.
bool Conversation::read(milliseconds patience) {
    if (!transport_) reconnect();
    const auto left = std::chrono::ceil<milliseconds>(place_.deadline - Clock::now());
    std::array<char, 8192> buffer{};
    const std::size_t count = transport_->read(buffer, std::clamp(left, milliseconds(0), patience));
    if (count == 0) return false;
    heard_at_ = Clock::now();
    if (unread_.empty()) heard_from_ = heard_at_;
    unread_.append(buffer.data(), count);
    keep(got_, {buffer.data(), count});
    return true;
}

}  // namespace scipd::tools::checks
