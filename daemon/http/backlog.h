// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Messages that several readers are still to get. Each message is kept once, however many readers
// wait for it. All messages have one order, and each reader has its own place in it. Where there is
// no room the oldest messages go, and the readers that are farthest behind lose them. Lives on the
// I/O thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "daemon/limits/limits.h"

namespace scipd::daemon {

class Backlog {
  public:
    /// Grows by one with each message.
    using Number = std::uint64_t;

    /// Who the messages come from.
    struct Source {
        std::string name;
        std::uint64_t lost = 0;        ///< the backlog's user counts here
        std::deque<Number> kept = {};  ///< numbers of its messages
    };
    struct Message {
        std::shared_ptr<Source> source;
        std::shared_ptr<const std::string> text;
    };
    using Lose = std::function<void(Number, const Message&)>;

    /// The backlog calls `lose` before a message goes for lack of room.
    explicit Backlog(Lose lose, SharedLimits limits = std::make_shared<Limits>())
        : lose_(std::move(lose)), limits_(std::move(limits)) {}

    void add(const std::shared_ptr<Source>& source, std::string text);
    /// Finds the first message from `number` on, and sets `number` to its own; null: there is none
    /// yet.
    [[nodiscard]] const Message* from(Number& number) const;
    [[nodiscard]] std::size_t bytes() const { return bytes_; }
    /// The number of the next message that is added.
    [[nodiscard]] Number end() const { return end_; }
    /// Drops the messages before this one: all readers have come to it.
    void forget_before(Number number);

  private:
    using Messages = std::map<Number, Message>;

    void make_room(Source& source);
    void lose(Messages::iterator message);
    void erase(Messages::iterator message);

    Lose lose_;
    SharedLimits limits_;
    Messages messages_;
    Number end_ = 0;
    std::size_t bytes_ = 0;
};

}  // namespace scipd::daemon
