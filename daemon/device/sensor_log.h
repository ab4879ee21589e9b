// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What sensors hand out of their latest measurements: one, or all that they have kept. Values; any
// thread. Whoever looks into one includes sensor_record.h.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <utility>
#include <variant>

#include "sim/sensor/scan.h"
#include "sim/time.h"

namespace scipd::daemon {

/// The latest measurement of a sensor. For people who compare it keeps those of the second before
/// as well, or fewer, as long as somebody has asked within a minute: they are large. A record stays
/// as it was made, in the scene of its time. It has the scan that was cast as `cast`.
template <class Record>
class RecordLog {
  public:
    using Shared = std::shared_ptr<const Record>;

    static constexpr sim::Time span = std::chrono::seconds(1);

    explicit RecordLog(std::size_t capacity = 64) : capacity_(capacity) {}

    /// Keeps records for another minute, since a client asks for them.
    void ask(sim::Time now) { asked_until_ = now + std::chrono::minutes(1); }

    void add(Shared record, sim::Time now) {
        const sim::Scan& scan = *record->cast;
        if (now >= asked_until_) records_.clear();
        // A revolution that is cast again replaces its record.
        while (!records_.empty() && last() >= scan.revolution)
            records_.pop_back();
        while (!records_.empty() &&
               (records_.size() >= capacity_ || scan.start - records_.front()->cast->start > span))
            records_.pop_front();
        records_.push_back(std::move(record));
    }

    /// Returns null where there is none.
    [[nodiscard]] Shared latest() const { return records_.empty() ? nullptr : records_.back(); }
    [[nodiscard]] Shared find(std::int64_t revolution) const {
        const auto found = std::ranges::find(
            records_, revolution, [](const Shared& record) { return record->cast->revolution; });
        return found == records_.end() ? nullptr : *found;
    }
    /// The first and the last of the revolutions. The log must hold something.
    [[nodiscard]] std::int64_t first() const { return records_.front()->cast->revolution; }
    [[nodiscard]] std::int64_t last() const { return records_.back()->cast->revolution; }

  private:
    std::size_t capacity_;
    std::deque<Shared> records_;  ///< by growing revolution
    sim::Time asked_until_ = sim::Time::min();
};

struct ScanRecord;
struct StaringRecord;

using SharedRecord = std::shared_ptr<const ScanRecord>;
using SharedStaringRecord = std::shared_ptr<const StaringRecord>;
using ScanLog = RecordLog<ScanRecord>;
using StaringLog = RecordLog<StaringRecord>;

/// What a scanner, or a camera or ranger, measured.
using SensorRecord = std::variant<SharedRecord, SharedStaringRecord>;
using SensorLog = std::variant<ScanLog, StaringLog>;

}  // namespace scipd::daemon
