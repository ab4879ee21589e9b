// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Limits how often the log repeats similar messages: at most N a second, by default one. The next
// message that is admitted carries the number of suppressed ones. Any thread; nothing shared.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace scipd::daemon {

class Throttle {
  public:
    using Time = std::chrono::steady_clock::time_point;

    explicit Throttle(std::size_t most_per_second = 1) : most_per_second_(most_per_second) {}

    /// Called for each message. Returns the text to append to it, which counts the messages that
    /// were suppressed before; nullopt: suppress this one, too.
    std::optional<std::string> admit(Time now) {
        if (!second_ || now - *second_ >= std::chrono::seconds(1)) {
            second_ = now;
            admitted_ = 0;
        }
        if (admitted_ == most_per_second_) {
            ++suppressed_;
            return std::nullopt;
        }
        ++admitted_;
        const std::string count = take_suppressed();
        return count.empty() ? count : " (" + count + ")";
    }

    /// "3 similar messages suppressed"; empty: none since the last message that was admitted.
    [[nodiscard]] std::string take_suppressed() {
        const std::uint64_t count = std::exchange(suppressed_, 0);
        if (count == 0) return {};
        return std::to_string(count) + " similar message" + (count == 1 ? "" : "s") + " suppressed";
    }

  private:
    std::size_t most_per_second_;
    std::optional<Time> second_;  ///< start of the present one
    std::size_t admitted_ = 0;    ///< since then
    std::uint64_t suppressed_ = 0;
};

}  // namespace scipd::daemon
