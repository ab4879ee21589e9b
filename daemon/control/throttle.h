// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How often people are told of what may happen thousands of times a second: at once, and then at
// most once a second, with how many were left out. Any thread; nothing shared.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <utility>

namespace scipd::daemon {

class Throttle {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// It has happened once more. Nothing: not to be told now; else how many before it were not.
    std::optional<std::uint64_t> admit(Time now) {
        if (last_ && now - *last_ < std::chrono::seconds(1)) {
            ++left_out_;
            return std::nullopt;
        }
        last_ = now;
        return std::exchange(left_out_, 0);
    }

  private:
    std::optional<Time> last_;
    std::uint64_t left_out_ = 0;
};

}  // namespace scipd::daemon
