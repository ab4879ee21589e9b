// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How much one sender sends in a second. It may send a second's worth at once; from then on, as
// much comes back as time goes by. Any thread; nothing shared.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>

namespace scipd::daemon {

class Rate {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// Called each time that something comes. False: that is more than so many in a second, and it
    /// does not count.
    [[nodiscard]] bool admit(std::size_t most, Time now = std::chrono::steady_clock::now()) {
        const std::chrono::duration<double> passed = now - last_;
        const auto a_second = static_cast<double>(most);
        used_ = std::max(0.0, used_ - passed.count() * a_second);
        last_ = now;
        if (used_ + 1.0 > a_second) return false;
        used_ += 1.0;
        return true;
    }

    /// Whether it is as if nothing had ever come.
    [[nodiscard]] bool rested(Time now) const { return now - last_ >= std::chrono::seconds(1); }

  private:
    double used_ = 0.0;
    Time last_{};
};

}  // namespace scipd::daemon
