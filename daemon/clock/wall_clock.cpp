// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/clock/wall_clock.h"

#include <cstdint>

#include <boost/asio/steady_timer.hpp>

namespace scipd::daemon {

class WallClock::TimerAlarm : public Clock::Alarm {
  public:
    explicit TimerAlarm(const WallClock& clock)
        : clock_(clock), pending_(std::make_shared<Pending>(clock.executor_)) {}
    ~TimerAlarm() override { pending_->timer.cancel(); }

    void set(sim::Time at, Call call) override {
        const std::uint64_t number = ++pending_->number;
        pending_->call = std::move(call);
        pending_->timer.expires_at(clock_.epoch_ + at);
        pending_->timer.async_wait(
            [weak = std::weak_ptr(pending_), number](const boost::system::error_code& error) {
                const auto pending = weak.lock();
                // A wait that ended before it could be cancelled reports no error.
                if (error || !pending || pending->number != number) return;
                const Call due = std::exchange(pending->call, nullptr);
                due();
            });
    }

    void cancel() override {
        ++pending_->number;
        pending_->call = nullptr;
        pending_->timer.cancel();
    }

  private:
    struct Pending {
        explicit Pending(const boost::asio::any_io_executor& executor) : timer(executor) {}
        boost::asio::steady_timer timer;
        Call call;
        std::uint64_t number = 0;
    };

    const WallClock& clock_;
    std::shared_ptr<Pending> pending_;
};

std::unique_ptr<Clock::Alarm> WallClock::make_alarm() {
    return std::make_unique<TimerAlarm>(*this);
}

}  // namespace scipd::daemon
