// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How late things happened, as a histogram. It has eight buckets an octave from 1 us on: so a
// quantile is at most 9 % too high, and the space is constant for any length of run. One thread.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace scipd::daemon {

class Lateness {
  public:
    using Duration = std::chrono::nanoseconds;

    void add(Duration lateness);
    /// The lateness that this share (0 to 1) of all did not exceed; nothing before the first.
    [[nodiscard]] std::optional<Duration> quantile(double share) const;
    [[nodiscard]] std::optional<Duration> max() const;

    /// How many there were.
    [[nodiscard]] std::uint64_t count() const { return count_; }
    /// How many of them were less than 2^octave microseconds late.
    [[nodiscard]] std::uint64_t below(int octave) const;
    /// The sum of all; what came too early adds nothing.
    [[nodiscard]] Duration sum() const { return sum_; }
    Lateness& operator+=(const Lateness& other);

  private:
    static constexpr int buckets_per_octave = 8;
    static constexpr int octaves = 27;  ///< to about two minutes

    std::array<std::uint64_t, buckets_per_octave * octaves> buckets_{};
    std::uint64_t count_ = 0;
    Duration max_{};
    Duration sum_{};
};

}  // namespace scipd::daemon
