// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Until when a client may send or take some more of a message. A message may be of any size, but in
// each stretch of patience much of it must pass: so a client that is slow on purpose keeps nothing
// for long. A value; one thread.
#pragma once

#include <chrono>
#include <cstddef>

namespace scipd::daemon {

class HttpPace {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// A new message begins.
    void begin(std::chrono::milliseconds patience) {
        patience_ = patience;
        passed_ = 0;
        end_ = std::chrono::steady_clock::now() + patience;
    }
    void pass(std::size_t bytes) {
        passed_ += bytes;
        if (passed_ >= enough) begin(patience_);
    }
    [[nodiscard]] Time end() const { return end_; }

  private:
    /// With a patience of a minute 17 kB a second, which the worst networks have.
    static constexpr std::size_t enough = 1'048'576;

    std::chrono::milliseconds patience_{};
    std::size_t passed_ = 0;
    Time end_{};
};

}  // namespace scipd::daemon
