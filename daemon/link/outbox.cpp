// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/link/outbox.h"

#include <utility>

namespace scipd::daemon {

bool Outbox::push(protocol::Send message) {
    const std::size_t size = message.bytes.size();
    if (message.kind == protocol::Send::Kind::scan && bytes_ + size > capacity_bytes) return false;
    bytes_ += size;
    messages_.push_back(std::move(message.bytes));
    return true;
}

std::string Outbox::pop() {
    std::string message = std::move(messages_.front());
    messages_.pop_front();
    bytes_ -= message.size();
    return message;
}

void Outbox::clear() {
    messages_.clear();
    bytes_ = 0;
}

}  // namespace scipd::daemon
