// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The wire to a scanner as raw bytes: it sends anything, cuts what comes into messages, and keeps
// both for the report. It judges nothing and knows no command. One thread.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "tools/scip_transport.h"
#include "tools/target.h"

namespace scipd::tools::checks {

using Clock = std::chrono::steady_clock;

class Conversation {
  public:
    struct Place {
        Target target;
        OpenOptions options;
        std::chrono::milliseconds patience{1000};               ///< for each answer
        Clock::time_point deadline = Clock::time_point::max();  ///< nothing is waited for any more
    };

    /// Connects. This, send() and what reads throw protocol::client::Error if the other end is
    /// gone, and Interrupted if the user wants the program to end.
    explicit Conversation(Place place);

    /// Hangs up where it is connected, and connects again.
    void reconnect();
    void hang_up();

    void send(std::string_view bytes);
    /// The next message with the empty line that ends it. Nothing: it does not come in time.
    [[nodiscard]] std::optional<std::string> message();
    [[nodiscard]] std::optional<std::string> message(std::chrono::milliseconds patience);
    /// All that comes until nothing has come for so long, or for a second more. message() does not
    /// get it.
    std::string listen(std::chrono::milliseconds quiet);
    /// True: nothing comes for so long.
    [[nodiscard]] bool quiet_for(std::chrono::milliseconds time);
    /// True: the other end hangs up within this time. What comes before that is kept.
    [[nodiscard]] bool ends_within(std::chrono::milliseconds time);

    /// When the last bytes came, and when the first of all that had not been taken by then.
    [[nodiscard]] Clock::time_point heard_at() const { return heard_at_; }
    [[nodiscard]] Clock::time_point heard_from() const { return heard_from_; }

    /// From here on sent() and got() begin anew.
    void begin();
    [[nodiscard]] const std::string& sent() const { return sent_; }
    [[nodiscard]] std::string_view last_line_sent() const;
    [[nodiscard]] const std::string& got() const { return got_; }
    [[nodiscard]] const Place& place() const { return place_; }
    [[nodiscard]] bool over() const { return Clock::now() >= place_.deadline; }

  private:
    bool read(std::chrono::milliseconds patience);

    Place place_;
    std::unique_ptr<ScipTransport> transport_;  ///< null: hung up
    std::string unread_;
    std::string sent_;
    std::string got_;
    Clock::time_point heard_at_{};
    Clock::time_point heard_from_{};
};

}  // namespace scipd::tools::checks
