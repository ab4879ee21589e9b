// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Why no library does this: Boost.Histogram fills as quickly (5.4 ns instead of 6.8 ns), but has no
// quantiles. It would replace the four lines of add() and be compiled by all who include a device.
#include "daemon/device/lateness.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <span>

namespace scipd::daemon {
namespace {

using Microseconds = std::chrono::duration<double, std::micro>;

}  // namespace

void Lateness::add(Duration lateness) {
    const double octave = std::log2(std::max(Microseconds(lateness).count(), 1.0));
    const auto bucket = static_cast<std::size_t>(octave * buckets_per_octave);
    ++buckets_[std::min(bucket, buckets_.size() - 1)];
    ++count_;
    max_ = std::max(max_, lateness);
    sum_ += std::max(lateness, Duration::zero());
}

std::uint64_t Lateness::below(int octave) const {
    const std::span within = std::span(buckets_).first(std::size_t(buckets_per_octave) * octave);
    return std::accumulate(within.begin(), within.end(), std::uint64_t(0));
}

Lateness& Lateness::operator+=(const Lateness& other) {
    std::ranges::transform(buckets_, other.buckets_, buckets_.begin(), std::plus());
    count_ += other.count_;
    max_ = std::max(max_, other.max_);
    sum_ += other.sum_;
    return *this;
}

std::optional<Lateness::Duration> Lateness::quantile(double share) const {
    if (count_ == 0) return std::nullopt;
    std::uint64_t seen = 0;
    std::size_t bucket = 0;
    for (; bucket + 1 < buckets_.size(); ++bucket) {
        seen += buckets_[bucket];
        if (static_cast<double>(seen) >= share * static_cast<double>(count_)) break;
    }
    const Microseconds upper_end(std::exp2(static_cast<double>(bucket + 1) / buckets_per_octave));
    return std::min(std::chrono::duration_cast<Duration>(upper_end), max_);
}

std::optional<Lateness::Duration> Lateness::max() const {
    return count_ == 0 ? std::nullopt : std::optional(max_);
}

}  // namespace scipd::daemon
