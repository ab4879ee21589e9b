// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/clock/stepped_clock.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace scipd::daemon {

class SteppedClock::QueuedAlarm : public Clock::Alarm {
  public:
    QueuedAlarm(SteppedClock& clock, bool idle, Ahead ahead = {})
        : clock_(clock), counts_(idle ? 0 : 1), ahead_(std::move(ahead)) {}
    ~QueuedAlarm() override { cancel(); }

    void set(sim::Time at, Call call) override {
        const bool awaited = clock_.awaited();
        cancel();
        place_ = clock_.queue_.emplace(at, this);
        call_ = std::move(call);
        done_ahead_ = false;
        clock_.awaited_ += counts_;
        if (!awaited && clock_.awaited()) clock_.on_awaited_();
    }

    void cancel() override {
        if (place_) {
            clock_.queue_.erase(*std::exchange(place_, std::nullopt));
            clock_.awaited_ -= counts_;
        }
        call_ = nullptr;
    }

    /// Leaves the queue first, because the call may destroy this alarm.
    Call take() {
        Call call = std::exchange(call_, nullptr);
        cancel();
        return call;
    }

    /// Null: nothing is left to be done ahead of the call.
    [[nodiscard]] const Ahead* take_ahead() {
        return ahead_.work && !std::exchange(done_ahead_, true) ? &ahead_ : nullptr;
    }

  private:
    SteppedClock& clock_;
    int counts_;  ///< 1: somebody waits for it
    Ahead ahead_;
    bool done_ahead_ = false;
    std::optional<std::multimap<sim::Time, QueuedAlarm*>::iterator> place_;
    Call call_;
};

std::unique_ptr<Clock::Alarm> SteppedClock::make_alarm() {
    return std::make_unique<QueuedAlarm>(*this, false);
}

std::unique_ptr<Clock::Alarm> SteppedClock::make_idle_alarm() {
    return std::make_unique<QueuedAlarm>(*this, true);
}

std::unique_ptr<Clock::Alarm> SteppedClock::make_slow_alarm(Ahead ahead) {
    return std::make_unique<QueuedAlarm>(*this, false, std::move(ahead));
}

// Only of calls that follow each other: what lies between may change what they do.
void SteppedClock::work_ahead() {
    Works works;
    for (auto next = queue_.begin(); next != queue_.end(); ++next) {
        if (next->first != queue_.begin()->first) break;
        const Ahead* const ahead = next->second->take_ahead();
        if (ahead == nullptr) break;
        works.push_back(ahead);
    }
    if (works.size() > 1) on_ahead_(works);
}

void SteppedClock::hold(const void* who, bool needed) {
    if (needed) {
        holders_.insert(who);
    } else if (holders_.erase(who) > 0 && holders_.empty()) {
        on_released_();
    }
}

bool SteppedClock::step(sim::Time until) {
    if (queue_.empty() || queue_.begin()->first > until) {
        now_ = std::max(now_, until);
        return false;
    }
    const auto [at, alarm] = *queue_.begin();
    now_ = std::max(now_, at);
    if (on_ahead_) work_ahead();
    const Call call = alarm->take();
    call();
    return true;
}

void SteppedClock::advance_to(sim::Time time) {
    while (step(time)) {
    }
}

}  // namespace scipd::daemon
