// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/http/backlog.h"

#include <utility>

namespace scipd::daemon {
namespace {

/// The messages of one source that are kept: a third of a second of a UST-10LX.
constexpr std::size_t most_of_a_source = 16;

}  // namespace

void Backlog::add(const std::shared_ptr<Source>& source, std::string text) {
    bytes_ += text.size();
    source->kept.push_back(end_);
    messages_[end_++] = {source, std::make_shared<const std::string>(std::move(text))};
    make_room(*source);
}

const Backlog::Message* Backlog::from(Number& number) const {
    const auto found = messages_.lower_bound(number);
    if (found == messages_.end()) return nullptr;
    number = found->first;
    return &found->second;
}

void Backlog::forget_before(Number number) {
    while (!messages_.empty() && messages_.begin()->first < number)
        erase(messages_.begin());
}

// Beyond the bytes of all sources together only the newest message of each source is kept, however
// many and large these are, so that no source is heard at the cost of another.
void Backlog::make_room(Source& source) {
    const std::size_t most_bytes = (*limits_)[Limit::websocket_queue_bytes];
    if (source.kept.size() > most_of_a_source) lose(messages_.find(source.kept.front()));
    for (auto message = messages_.begin(); bytes_ > most_bytes && message != messages_.end();) {
        const auto oldest = message++;
        if (oldest->second.source->kept.size() <= 1) continue;
        limits_->refuse(Limit::websocket_queue_bytes, "/stream");
        lose(oldest);
    }
}

void Backlog::lose(Messages::iterator message) {
    lose_(message->first, message->second);
    erase(message);
}

/// The message is always the oldest of its source.
void Backlog::erase(Messages::iterator message) {
    bytes_ -= message->second.text->size();
    message->second.source->kept.pop_front();
    messages_.erase(message);
}

}  // namespace scipd::daemon
