// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The scans of a recording in the words of a scanner's wire. They lie in a file that has no name:
// so a long recording takes no memory, and each scan is found at once. Written by one thread; then
// read by any.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <vector>

#include "protocol/scan_view.h"
#include "sim/time.h"

namespace scipd::daemon {

/// The values of one scan, step by step from the first that is measured.
struct TapedScan {
    std::vector<std::uint32_t> distance;  ///< mm, or a code, as recorded
    std::vector<std::uint32_t> intensity;
    std::vector<protocol::StepEchoes> echoes;  ///< of recordings that tell several; else empty
};

class Tape {
  public:
    /// For scans of so many steps. Throws std::runtime_error where no file can be made.
    Tape(std::size_t steps, bool has_echoes);

    /// Throws std::runtime_error where the disk is full.
    void add(const TapedScan& scan, std::uint32_t stamp_ms, sim::Time begin);
    /// When the first scan was recorded, since 1970.
    void set_recorded(std::optional<sim::Time> recorded) { recorded_ = recorded; }
    /// Scans from `to` on come as much earlier as `from` is before that. None is between them.
    void cut(sim::Time from, sim::Time to);
    /// No scan follows. The last one takes as long as this.
    void end(sim::Time last);

    [[nodiscard]] std::optional<sim::Time> recorded() const { return recorded_; }
    [[nodiscard]] std::size_t size() const { return stamps_ms_.size(); }
    [[nodiscard]] TapedScan scan(std::size_t index) const;
    /// The scanner's own clock at step 0, 24 bits.
    [[nodiscard]] std::uint32_t stamp_ms(std::size_t index) const { return stamps_ms_[index]; }
    /// From the first scan to this one; of size(): to the end.
    [[nodiscard]] sim::Time begin(std::size_t index) const { return begins_[index]; }
    /// From this scan to the next.
    [[nodiscard]] sim::Time lasts(std::size_t index) const {
        return begins_[index + 1] - begins_[index];
    }
    /// The scan that is under way at this time since the first one.
    [[nodiscard]] std::size_t at(sim::Time since_first) const;
    /// The first scan that begins at this time since the first one, or later; size(): none does.
    [[nodiscard]] std::size_t next(sim::Time since_first) const;

  private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };

    [[nodiscard]] std::size_t bytes_of_scan() const;

    std::size_t steps_;
    bool has_echoes_;
    std::unique_ptr<std::FILE, Close> file_;
    std::optional<sim::Time> recorded_;
    std::vector<std::uint32_t> stamps_ms_;
    std::vector<sim::Time> begins_;  ///< and the end
};

using SharedTape = std::shared_ptr<const Tape>;

}  // namespace scipd::daemon
