// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/api/recordings.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "daemon/api/lane.h"
#include "daemon/api/scan_file.h"
#include "daemon/device/device.h"

namespace scipd::daemon {
namespace {

/// That wait for the I/O thread. In lockstep many may come before it looks.
constexpr std::size_t most_waiting = 1000;

}  // namespace

struct Recordings::Recording {
    Order order;
    sim::Time unix_origin;  ///< asked once, so that a step of the host's clock tears nothing
    std::vector<sim::RecordedScan> scans = {};
    bool complete = false;
    std::optional<std::stop_callback<std::function<void()>>> on_withdrawn = {};
};

Recordings::Tap::Tap(Recordings& recordings, std::string name, Device& device)
    : recordings_(recordings), name_(std::move(name)), device_(device) {
    recordings_.taps_.push_back(this);
    recordings_.follow(*this);
}

Recordings::Tap::~Tap() {
    std::erase(recordings_.taps_, this);
    device_.watch(nullptr, WatchedBy::recordings);
    recordings_.end_those_of(name_);
}

void Recordings::begin(Order order) {
    const auto recording = std::make_shared<Recording>(std::move(order), clock_.unix_origin());
    recordings_.push_back(recording);
    follow_all();
    recording->on_withdrawn.emplace(recording->order.withdrawn,
                                    [this, it = recording.get()] { forget(it); });
}

void Recordings::follow_all() {
    ways_.to_sensors([this] {
        for (Tap* tap : taps_)
            follow(*tap);
    });
}

void Recordings::follow(Tap& tap) {
    const bool wanted = std::ranges::any_of(
        recordings_, [&](const auto& recording) { return recording->order.sensor == tap.name_; });
    if (std::exchange(tap.watches_, wanted) == wanted) return;
    if (!wanted) return tap.device_.watch(nullptr, WatchedBy::recordings);
    const auto identity =
        std::make_shared<const sim::ScannerIdentity>(identity_of(tap.device_.profile()));
    tap.device_.watch(
        [this, name = tap.name_, identity,
         lane = Lane(ways_.to_stream, most_waiting)](const ScanRecord& record) mutable {
            if (lane.loses_next()) return;
            lane.post(0, [this, name, identity, scan = recorded_scan(record, *identity)] {
                take(name, identity, scan);
            });
        },
        WatchedBy::recordings);
}

void Recordings::take(const std::string& sensor, const SharedIdentity& identity,
                      const sim::RecordedScan& scan) {
    for (const auto& recording : recordings_) {
        if (recording->order.sensor != sensor || recording->complete) continue;
        recording->scans.push_back(scan);
        *recording->scans.back().host_time += recording->unix_origin;
        recording->complete = recording->scans.size() == recording->order.scans;
        if (recording->complete) finish(recording, identity);
    }
}

// The scanner may be telling of a scan right now: it is left alone until the file is made.
void Recordings::finish(const std::shared_ptr<Recording>& recording,
                        const SharedIdentity& identity) {
    aside_([this, recording, identity]() -> Worker::Work {
        return [this, recording, identity, ending = recording->order.ending,
                scans = std::move(recording->scans)]() -> Worker::Finish {
            return [this, recording, file = scan_file(ending, *identity, scans)]() mutable {
                forget(recording.get());
                if (!recording->order.withdrawn.stop_requested())
                    recording->order.done(std::move(file));
            };
        };
    });
}

// Once sensors go on: an answer may take a while.
void Recordings::end_those_of(const std::string& sensor) {
    for (const auto& recording : std::vector(recordings_)) {
        if (recording->order.sensor != sensor || std::exchange(recording->complete, true)) continue;
        ways_.to_stream([this, recording] {
            forget(recording.get());
            if (!recording->order.withdrawn.stop_requested()) recording->order.gone();
        });
    }
}

// Called by a Recording's own on_withdrawn as well, which may end within its call.
void Recordings::forget(const Recording* recording) {
    std::erase_if(recordings_, [&](const auto& one) { return one.get() == recording; });
    follow_all();
}

}  // namespace scipd::daemon
