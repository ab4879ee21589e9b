// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/faults/fault_schedule.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "daemon/faults/fault_kind.h"
#include "sim/random.h"

namespace scipd::daemon {
namespace {

template <class Value, class Variant>
const Value* as(const Variant& variant) {
    return std::get_if<Value>(&variant);
}

/// When the repetition of this number begins, counted from when the fault was asked for.
template <class Distance>
Distance offset_of(const Every<Distance>& every, std::int64_t repetition, std::uint64_t seed) {
    const sim::Chance chance({.seed = seed,
                              .scan = static_cast<std::uint64_t>(repetition),
                              .purpose = sim::Purpose::fault_begin});
    const Distance even{every.distance * repetition};
    if constexpr (std::is_same_v<Distance, sim::Time>) {
        return even + std::chrono::round<sim::Time>(every.jitter * chance.even(0));
    } else {
        return even + static_cast<Distance>(
                          std::llround(static_cast<double>(every.jitter) * chance.even(0)));
    }
}

}  // namespace

FaultSchedule::FaultSchedule(const FaultPlan& plan, std::uint64_t seed, const FaultMoment& asked)
    : start_(plan.start),
      end_(plan.end),
      every_(plan.every),
      seed_(seed),
      momentary_(plan.kind->momentary && as<UntilStopped>(plan.end) != nullptr),
      asked_(asked) {
    if (const auto* const request = as<AtRequest>(start_)) requests_left_ = request->nth;
    if (as<std::monostate>(every_) == nullptr) repetition_ = 1;
}

std::optional<std::int64_t> FaultSchedule::next_scan() const {
    if (phase_ == Phase::active) {
        const auto* const for_scans = as<ForScans>(end_);
        return for_scans ? std::optional(first_scan_ + for_scans->scans) : std::nullopt;
    }
    if (phase_ == Phase::ended) return std::nullopt;
    if (const auto* const every = as<Every<std::int64_t>>(every_))
        return asked_.scan + offset_of(*every, repetition_, seed_);
    if (const auto* const at = as<AtScan>(start_)) return at->scan;
    if (const auto* const after = as<AfterScans>(start_)) return asked_.scan + after->scans;
    return std::nullopt;
}

std::optional<sim::Time> FaultSchedule::next_time(sim::Time origin) const {
    if (phase_ == Phase::active) {
        if (momentary_) return begun_;
        const auto* const for_time = as<ForTime>(end_);
        return for_time ? std::optional(begun_ + for_time->time) : std::nullopt;
    }
    if (phase_ == Phase::ended) return std::nullopt;
    if (const auto* const every = as<Every<sim::Time>>(every_))
        return asked_.time + offset_of(*every, repetition_, seed_);
    if (as<std::monostate>(every_) == nullptr) return std::nullopt;
    if (as<AtOnce>(start_) != nullptr) return asked_.time;
    if (const auto* const at = as<AtTime>(start_)) return at->told - origin;
    if (const auto* const after = as<AfterTime>(start_)) return asked_.time + after->time;
    return std::nullopt;
}

bool FaultSchedule::due(const FaultMoment& now) const {
    if (phase_ != Phase::waiting) return false;
    if (const auto scan = next_scan()) return now.scan >= *scan;
    const auto time = next_time(now.origin);
    return time && now.time >= *time;
}

bool FaultSchedule::over(const FaultMoment& now) const {
    if (phase_ != Phase::active) return false;
    if (const auto scan = next_scan()) return now.scan >= *scan;
    const auto time = next_time(now.origin);
    return time && now.time >= *time;
}

bool FaultSchedule::begins_with(std::string_view command) {
    const auto* const request = as<AtRequest>(start_);
    if (phase_ != Phase::waiting || request == nullptr || request->command != command) return false;
    return --requests_left_ <= 0;
}

bool FaultSchedule::ends_with(std::string_view command) const {
    const auto* const request = as<UntilRequest>(end_);
    return phase_ == Phase::active && request != nullptr && request->command == command;
}

// What is due is noticed late where nobody asks for scans, or where the machine is slow. It lasts
// from when it was due.
void FaultSchedule::begin(const FaultMoment& now) {
    const auto scan = next_scan();
    const auto time = next_time(now.origin);
    first_scan_ =
        scan ? std::clamp(*scan, std::min(asked_.scan + 1, now.next_scan()), now.next_scan())
             : now.next_scan();
    begun_ = time ? std::min(std::max(*time, asked_.time), now.time) : now.time;
    phase_ = Phase::active;
}

void FaultSchedule::end(const FaultMoment& now) {
    phase_ = repetition_ == 0 ? Phase::ended : Phase::waiting;
    if (repetition_ != 0) wait_for_repetition(now);
}

// One that would have begun while the one before was still active is left out.
void FaultSchedule::wait_for_repetition(const FaultMoment& now) {
    std::int64_t passed = 0;
    if (const auto* const every = as<Every<std::int64_t>>(every_))
        passed = (now.scan - asked_.scan) / every->distance;
    if (const auto* const every = as<Every<sim::Time>>(every_))
        passed = (now.time - asked_.time) / every->distance;
    // A jitter is less than half the distance, so that the order stays.
    repetition_ = std::max(repetition_ + 1, passed);
    while (due(now))
        ++repetition_;
}

}  // namespace scipd::daemon
