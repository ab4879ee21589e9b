// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A client that checks all that it is told: each message is whole, has its sums, can be read by
// protocol/client, is no longer than its request permits, and answers this client's own next
// request or belongs to its own stream.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/client/message.h"
#include "protocol/device_profile.h"
#include "protocol/line_reader.h"
#include "tests/protocol/shell.h"

namespace scipd::protocol {

/// The longest message that may begin with this echo: every value as wide as can be, every step
/// with all the echoes there can be.
[[nodiscard]] std::size_t longest_message(std::string_view echo);

class Listener {
  public:
    /// `profile` must outlive it.
    explicit Listener(const DeviceProfile& profile) : profile_(profile) {}

    /// It has sent these bytes.
    void said(std::string_view bytes);
    /// The link is lost: nothing of what it asked will be answered.
    void forget();
    /// What is wrong with this message; empty: nothing.
    [[nodiscard]] std::string hear(const Sent& sent);
    /// It still waits for answers.
    [[nodiscard]] std::size_t unanswered() const { return requests_.size(); }

  private:
    struct Stream {
        std::string head;  ///< its echo without the number of scans
        std::string tail;
        int scans = 0;
        int heard = 0;
    };

    [[nodiscard]] std::string hear_reply(const client::Message& message);
    [[nodiscard]] std::string hear_scan(const client::Message& message);
    void follow(const client::Message& reply);

    const DeviceProfile& profile_;
    LineReader reader_;
    std::deque<std::string> requests_;
    std::optional<Stream> stream_;
    Uptime last_{};
};

}  // namespace scipd::protocol
