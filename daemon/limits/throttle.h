// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Decides how often people are told of what may happen thousands of times a second: the first time
// at once, then at most once a second, with the number of those left out. Any thread; nothing
// shared.
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

    /// Called each time that it happens. Nothing: do not tell it now. Otherwise the text to add
    /// when it is told, which says how many times before were not told.
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
