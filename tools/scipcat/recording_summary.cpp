// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/recording_summary.h"

#include <algorithm>
#include <chrono>
#include <utility>
#include <variant>

namespace scipd::tools {
namespace {

using sim::RecordedScan;
using std::chrono::duration;

/// By the scanner's clock; nothing where it is not known or went back, as it does at a new start.
std::optional<double> stamped_seconds_between(const RecordedScan& before,
                                              const RecordedScan& scan) {
    constexpr std::uint32_t stamps = 1U << 24;  // a stamp of 24 bits wraps after 4.66 hours
    if (before.stamp_us && scan.stamp_us && *scan.stamp_us >= *before.stamp_us)
        return static_cast<double>(*scan.stamp_us - *before.stamp_us) / 1e6;
    if (before.stamp_ms && scan.stamp_ms) {
        const std::uint32_t forward_ms = (*scan.stamp_ms - *before.stamp_ms) % stamps;
        if (forward_ms < stamps / 2) return forward_ms / 1e3;
    }
    return std::nullopt;
}

/// The seconds from one scan to the next, not negative; nullopt where neither clock says.
std::optional<double> seconds_between(const RecordedScan& before, const RecordedScan& scan) {
    if (const auto stamped = stamped_seconds_between(before, scan)) return stamped;
    if (before.host_time && scan.host_time)
        return std::max(duration<double>(*scan.host_time - *before.host_time).count(), 0.0);
    return std::nullopt;
}

class StreamReader {
  public:
    void take(sim::RecordedItem& item, RecordedScan scan) {
        ++summary_.scans;
        if (item.stamped) ++summary_.stamped;
        if (item.logged && !item.stamped) ++summary_.logged;
        summary_.steps = std::max(summary_.steps, scan.steps());
        summary_.intensities = summary_.intensities || !scan.intensities.empty();
        summary_.echoes = summary_.echoes || scan.has_echoes();
        summary_.codes = scan.unit == sim::RangeUnit::millimetres;
        if (summary_.scans == 1) summary_.begin = scan.host_time;
        if (summary_.scans > 1) intervals_s_.push_back(seconds_between(last_, scan).value_or(0));
        last_ = std::move(scan);
    }

    [[nodiscard]] StreamSummary finish(const sim::RecordedStream& stream) && {
        summary_.stream = stream;
        for (const double interval_s : intervals_s_)
            summary_.seconds += interval_s;
        find_gaps();
        return std::move(summary_);
    }

  private:
    void find_gaps() {
        if (intervals_s_.empty()) return;
        std::vector<double> sorted = intervals_s_;
        const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
        std::ranges::nth_element(sorted, middle);
        if (*middle <= 0) return;
        for (std::size_t i = 0; i < intervals_s_.size(); ++i) {
            if (intervals_s_[i] > 1.5 * *middle) summary_.gaps.push_back({i + 1, intervals_s_[i]});
        }
    }

    StreamSummary summary_;
    RecordedScan last_;
    std::vector<double> intervals_s_;
};

}  // namespace

sim::Expected<RecordingSummary> summarize(sim::Recording& recording) {
    std::vector<StreamReader> readers;
    for (;;) {
        auto item = recording.next();
        if (!item) return tl::unexpected(item.error());
        readers.resize(recording.streams().size());
        if (!*item) break;
        auto* const scan = std::get_if<RecordedScan>(&(*item)->what);
        if (scan != nullptr) readers[(*item)->stream].take(**item, std::move(*scan));
    }
    RecordingSummary summary{recording.format(), {}, recording.warnings()};
    for (std::size_t i = 0; i < readers.size(); ++i)
        summary.streams.push_back(std::move(readers[i]).finish(recording.streams()[i]));
    return summary;
}

}  // namespace scipd::tools
