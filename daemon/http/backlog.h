// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Messages that several readers are still to get: each is kept once, however many wait for it, and
// each reader has a place of its own in the order of them all. Of what does not fit the oldest go,
// at the cost of those who are farthest behind. Lives on the I/O thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>

namespace scipd::daemon {

class Backlog {
  public:
    /// Grows by one with each message.
    using Number = std::uint64_t;

    /// Whose messages they are.
    struct Source {
        std::string name;
        std::uint64_t lost = 0;        ///< for whoever keeps this number
        std::deque<Number> kept = {};  ///< of its messages
    };
    struct Message {
        std::shared_ptr<Source> source;
        std::shared_ptr<const std::string> text;
    };
    using Lose = std::function<void(Number, const Message&)>;

    /// `lose` is called before a message goes for lack of room.
    explicit Backlog(Lose lose) : lose_(std::move(lose)) {}

    void add(const std::shared_ptr<Source>& source, std::string text);
    /// The first one from there on; null: there is none yet.
    [[nodiscard]] const Message* from(Number& number) const;
    [[nodiscard]] std::size_t bytes() const { return bytes_; }
    /// Of the next message that is added.
    [[nodiscard]] Number end() const { return end_; }
    /// All readers have come to this one.
    void forget_before(Number number);

  private:
    using Messages = std::map<Number, Message>;

    void make_room(Source& source);
    void lose(Messages::iterator message);
    void erase(Messages::iterator message);

    Lose lose_;
    Messages messages_;
    Number end_ = 0;
    std::size_t bytes_ = 0;
};

}  // namespace scipd::daemon
