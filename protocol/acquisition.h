// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What one client has begun and not ended: a stream, a request for one scan, the laser or adjust
// mode. Told of every turn of the mirror, it says which scans it wants and makes messages of them.
// Lives on the thread of its session.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "protocol/device_profile.h"
#include "protocol/device_state.h"
#include "protocol/request.h"
#include "protocol/scan_view.h"
#include "protocol/step_window.h"
#include "protocol/subscription.h"

namespace scipd::protocol {

class Acquisition {
  public:
    /// A request whose reply is the latest complete scan.
    struct SingleScan {
        Request request;  ///< without a command: in SCIP 1.1
        StepWindow window;
        Uptime begun{};
    };

    /// Both must outlive it.
    Acquisition(const DeviceProfile& profile, DeviceState& device)
        : profile_(profile), device_(device) {}

    // The device.

    /// This client has switched the laser on or entered adjust mode.
    void hold_device() { holds_device_ = true; }
    void release_device() { holds_device_ = false; }
    /// The stream ends. The laser goes off unless other clients stream.
    void stop();
    /// The client is gone: what it holds ends as by QT and TM2.
    void close();
    /// The device has booted: nothing of this client is under way any more.
    void lose();

    // Turns and scans.

    /// Scans are wanted now or later.
    [[nodiscard]] bool measuring() const { return streaming() || awaits_scan(); }
    /// Whether somebody wants the scan of this turn, which has just fired its last step. To be told
    /// of each turn while measuring(), in order.
    [[nodiscard]] bool turn_complete(const Turn& turn);
    /// Returns true if this is a turn, or not before the first turn, that it takes a scan of.
    [[nodiscard]] bool has_begun(const Turn& turn) const;

    // The stream.

    /// Replaces the stream that is under way. Switches the laser on.
    void stream(Subscription subscription, Uptime now);
    [[nodiscard]] bool streaming() const;
    /// The stream's message with this scan. Nothing: the stream did not want it.
    [[nodiscard]] std::optional<std::string> stream_message(const ScanView& scan);

    // The single scan.

    void await_scan(SingleScan awaited) { single_scan_ = std::move(awaited); }
    [[nodiscard]] bool awaits_scan() const { return single_scan_.has_value(); }
    /// The laser has gone off or the device has failed: the scan will not come.
    [[nodiscard]] bool awaits_scan_in_vain() const;
    /// Whether this turn, complete by now, answers the request for a single scan.
    [[nodiscard]] bool awaits(const Turn& turn) const;
    /// The reply with this scan. Only while awaits() its turn.
    [[nodiscard]] std::string single_scan_reply(const ScanView& scan);
    /// Gives the request back, for another reply. Only while awaits_scan().
    [[nodiscard]] Request give_up_scan();
    void forget_scan() { single_scan_.reset(); }

  private:
    /// Turns that begin earlier have no scan. Meaningless while the laser is off.
    [[nodiscard]] Uptime settled_at() const;

    const DeviceProfile& profile_;
    DeviceState& device_;
    bool holds_device_ = false;
    std::optional<Subscription> subscription_;
    DeviceState::StreamId stream_ = 0;
    std::vector<Uptime> taken_turns_;  ///< begins of turns whose scans the stream still waits for
    std::optional<SingleScan> single_scan_;
};

}  // namespace scipd::protocol
