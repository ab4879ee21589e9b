// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What pages are told of faults on purpose: messages {"faults":[..]}, each made once for all pages.
// A fault that acts is a message at once. Those that act until the next look are one together, so
// that many faults are no more messages than few. Only the latest messages are kept, for pages that
// are slow. Lives on the I/O thread.
#pragma once

#include <deque>
#include <memory>
#include <string>

#include "daemon/http/backlog.h"

namespace scipd::daemon {

class FaultNews {
  public:
    /// Takes a fault_event(). Whether that made a message.
    bool add(const std::string& event);
    /// Makes a message of what has come since the last one, if anything has.
    bool look();

    /// As those of a backlog.
    [[nodiscard]] const Backlog::Message* from(Backlog::Number& number) const {
        return messages_.from(number);
    }
    [[nodiscard]] Backlog::Number end() const { return messages_.end(); }

  private:
    std::deque<std::string> events_;
    bool told_ = false;  ///< since the last look
    Backlog messages_{[](Backlog::Number, const Backlog::Message&) {}};
    std::shared_ptr<Backlog::Source> source_ = std::make_shared<Backlog::Source>();
};

}  // namespace scipd::daemon
