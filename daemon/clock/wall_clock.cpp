// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/clock/wall_clock.h"

#include <cstdint>

#include <boost/asio/steady_timer.hpp>

namespace scipd::daemon {

class WallClock::TimerAlarm : public Clock::Alarm {
  public:
    TimerAlarm(const WallClock& clock, bool slow)
        : clock_(clock), slow_(slow), pending_(std::make_shared<Pending>(clock.executor_)) {}
    ~TimerAlarm() override { pending_->timer.cancel(); }

    void set(sim::Time at, Call call) override {
        const std::uint64_t number = ++pending_->number;
        pending_->call = std::move(call);
        pending_->timer.expires_at(clock_.epoch_ + at);
        pending_->timer.async_wait(
            [this, weak = std::weak_ptr(pending_), number](const boost::system::error_code& error) {
                if (error || weak.expired()) return;
                if (slow_) return clock_.defer_([weak, number] { make(weak, number); });
                make(weak, number);
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

    // A wait that ended before it could be cancelled reports no error.
    static void make(const std::weak_ptr<Pending>& weak, std::uint64_t number) {
        const auto pending = weak.lock();
        if (!pending || pending->number != number) return;
        const Call due = std::exchange(pending->call, nullptr);
        due();
    }

    const WallClock& clock_;
    bool slow_;
    std::shared_ptr<Pending> pending_;
};

std::unique_ptr<Clock::Alarm> WallClock::make_alarm() {
    return std::make_unique<TimerAlarm>(*this, false);
}

std::unique_ptr<Clock::Alarm> WallClock::make_slow_alarm(Beside /*beside*/) {
    return std::make_unique<TimerAlarm>(*this, true);
}

}  // namespace scipd::daemon
