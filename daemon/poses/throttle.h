// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How often people are told of what may happen thousands of times a second: at once, and then at
// most once a second, with how many were left out. Any thread; nothing shared.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace scipd::daemon {

class Throttle {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// It has happened once more. Nothing: not to be told now; else what to add when it is told, of
    /// how many before it were not.
    std::optional<std::string> admit(Time now) {
        if (last_ && now - *last_ < std::chrono::seconds(1)) {
            ++left_out_;
            return std::nullopt;
        }
        last_ = now;
        const std::uint64_t others = std::exchange(left_out_, 0);
        return others == 0 ? "" : " (" + std::to_string(others) + " others before)";
    }

  private:
    std::optional<Time> last_;
    std::uint64_t left_out_ = 0;
};

}  // namespace scipd::daemon
