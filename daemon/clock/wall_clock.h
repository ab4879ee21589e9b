// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The clock for scanners whose drivers know only real time. Each thread has one of its own.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <utility>

#include <boost/asio/any_io_executor.hpp>

#include "daemon/clock/clock.h"

namespace scipd::daemon {

/// The steady clock as world time, which is 0 when this object is made. No other code of the
/// simulation reads a clock. Calls come from `executor`.
class WallClock : public Clock {
  public:
    explicit WallClock(boost::asio::any_io_executor executor) : executor_(std::move(executor)) {}
    /// Shows the time of `same`, and calls from another executor. `defer` makes calls that take
    /// long, later.
    using Defer = std::function<void(Call)>;
    WallClock(const WallClock& same, boost::asio::any_io_executor executor, Defer defer)
        : executor_(std::move(executor)), defer_(std::move(defer)), epoch_(same.epoch_) {}

    [[nodiscard]] sim::Time now() const override { return Steady::now() - epoch_; }
    [[nodiscard]] sim::Time unix_origin() const override {
        return std::chrono::system_clock::now().time_since_epoch() - now();
    }
    [[nodiscard]] std::unique_ptr<Alarm> make_alarm() override;
    [[nodiscard]] std::unique_ptr<Alarm> make_slow_alarm(Beside beside) override;

  private:
    using Steady = std::chrono::steady_clock;
    class TimerAlarm;

    boost::asio::any_io_executor executor_;
    Defer defer_ = [](const Call& call) { call(); };
    Steady::time_point epoch_ = Steady::now();
};

}  // namespace scipd::daemon
