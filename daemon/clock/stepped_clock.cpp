// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/clock/stepped_clock.h"

#include <algorithm>
#include <cassert>
#include <optional>
#include <utility>

namespace scipd::daemon {
namespace {

/// No call sets more alarms than this.
constexpr std::uint64_t most_set_by_a_call = 1 << 16;

/// The order of what this thread sets next. Null: no call is made beside others here.
thread_local std::uint64_t* order_in_call = nullptr;

class InOrderFrom {
  public:
    explicit InOrderFrom(std::uint64_t order) : order_(order) { order_in_call = &order_; }
    InOrderFrom(const InOrderFrom&) = delete;
    InOrderFrom& operator=(const InOrderFrom&) = delete;
    ~InOrderFrom() { order_in_call = nullptr; }

  private:
    std::uint64_t order_;
};

}  // namespace

class SteppedClock::QueuedAlarm : public Clock::Alarm {
  public:
    QueuedAlarm(SteppedClock& clock, bool idle, Beside beside = {})
        : clock_(clock), counts_(idle ? 0 : 1), beside_(std::move(beside)) {}
    ~QueuedAlarm() override { cancel(); }

    void set(sim::Time at, Call call) override {
        cancel();
        call_ = std::move(call);
        place_ = clock_.next_place(at);
        clock_.enter(*place_, *this, counts_);
    }

    void cancel() override {
        if (place_) clock_.leave(*std::exchange(place_, std::nullopt), counts_);
        call_ = nullptr;
    }

    /// Leaves the queue first, because the call may destroy this alarm.
    Call take() {
        Call call = std::exchange(call_, nullptr);
        cancel();
        return call;
    }

    [[nodiscard]] bool may_be_made_beside() const { return beside_.may && beside_.may(); }
    [[nodiscard]] std::size_t shard() const { return beside_.shard; }

  private:
    SteppedClock& clock_;
    int counts_;  ///< 1: somebody waits for it
    Beside beside_;
    std::optional<Place> place_;
    Call call_;
};

std::unique_ptr<Clock::Alarm> SteppedClock::make_alarm() {
    return std::make_unique<QueuedAlarm>(*this, false);
}

std::unique_ptr<Clock::Alarm> SteppedClock::make_idle_alarm() {
    return std::make_unique<QueuedAlarm>(*this, true);
}

std::unique_ptr<Clock::Alarm> SteppedClock::make_slow_alarm(Beside beside) {
    return std::make_unique<QueuedAlarm>(*this, false, std::move(beside));
}

SteppedClock::Place SteppedClock::next_place(sim::Time at) {
    return {at, order_in_call != nullptr ? (*order_in_call)++ : next_order_++};
}

void SteppedClock::enter(const Place& place, QueuedAlarm& alarm, int counts) {
    bool first = false;
    {
        const std::lock_guard lock(mutex_);
        queue_.emplace(place, &alarm);
        first = awaited_ == 0 && counts > 0;
        awaited_ += counts;
    }
    if (first && !side_by_side_) on_awaited_();
}

void SteppedClock::leave(const Place& place, int counts) {
    const std::lock_guard lock(mutex_);
    queue_.erase(place);
    awaited_ -= counts;
}

void SteppedClock::hold(const void* who, bool needed) {
    bool released = false;
    {
        const std::lock_guard lock(mutex_);
        if (needed) {
            holders_.insert(who);
        } else {
            released = holders_.erase(who) > 0 && holders_.empty();
        }
    }
    if (released && !side_by_side_) on_released_();
}

// Only those that follow each other: what lies between may change what they do.
std::vector<SteppedClock::QueuedAlarm*> SteppedClock::due_side_by_side() const {
    std::vector<QueuedAlarm*> due;
    if (!make_beside_) return due;
    const sim::Time at = queue_.begin()->first.first;
    for (const auto& [place, alarm] : queue_) {
        if (place.first != at || !alarm->may_be_made_beside()) break;
        due.push_back(alarm);
    }
    return due;
}

void SteppedClock::call_side_by_side(const std::vector<QueuedAlarm*>& alarms) {
    std::vector<SlowCall> calls;
    for (QueuedAlarm* const alarm : alarms) {
        const std::uint64_t first = next_order_ + calls.size() * most_set_by_a_call;
        calls.push_back({alarm->shard(), [first, call = alarm->take()] {
                             const InOrderFrom in_order(first);
                             call();
                             assert(*order_in_call < first + most_set_by_a_call);
                         }});
    }
    next_order_ += calls.size() * most_set_by_a_call;
    const bool was_awaited = awaited();
    const bool was_held = held();
    side_by_side_ = true;
    make_beside_(calls);
    side_by_side_ = false;
    if (!was_awaited && awaited()) on_awaited_();
    if (was_held && !held()) on_released_();
}

std::size_t SteppedClock::step(sim::Time until) {
    on_step_();
    if (queue_.empty() || queue_.begin()->first.first > until) {
        now_ = std::max(now_, until);
        return 0;
    }
    const auto [place, alarm] = *queue_.begin();
    now_ = std::max(now_, place.first);
    const std::vector<QueuedAlarm*> beside = due_side_by_side();
    if (beside.size() > 1) {
        call_side_by_side(beside);
        return beside.size();
    }
    alarm->take()();
    return 1;
}

void SteppedClock::advance_to(sim::Time time) {
    while (step(time) > 0) {
    }
}

}  // namespace scipd::daemon
