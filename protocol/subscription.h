// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One running stream of scans: which turns it takes and how its messages look. It knows nothing of
// laser and modes.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <variant>

#include "protocol/device_profile.h"
#include "protocol/device_state.h"
#include "protocol/reply.h"
#include "protocol/request.h"
#include "protocol/scan_view.h"
#include "protocol/status.h"
#include "protocol/step_window.h"

namespace scipd::protocol {

class Subscription {
  public:
    /// The stream that a request with Parameters::scans asks for, or the status (of status::scan)
    /// of the first thing that is wrong with it. The request came in at `arrived`, when a turn took
    /// `scan_period`.
    static std::variant<Subscription, Status> from(const Request& request, Uptime arrived,
                                                   Uptime scan_period,
                                                   const DeviceProfile& profile);

    /// Whether the stream takes this turn. To be asked once, in order, for every turn that fires
    /// its last step after the acknowledgement. With interval n the stream passes over n turns
    /// before each one that it takes. The first of them is the turn under way when the request came
    /// in: a recorded UTM-30LX answers at the end of that turn, and with interval 1 it sends the
    /// very next one, 27 ms after its answer. A turn that began before the laser had settled has
    /// no scan.
    [[nodiscard]] bool takes(const Turn& turn, Uptime settled_at);
    /// Returns true if no turn as late as this one is too early for it.
    [[nodiscard]] bool has_begun(const Turn& turn, Uptime settled_at) const {
        return turn.start > after_ && turn.start >= settled_at;
    }

    /// The message with this scan, which counts as one of the scans that were asked for.
    [[nodiscard]] std::string message(const ScanView& scan, const DeviceState& device,
                                      const DeviceProfile& profile);

    /// The status that is sent in the place of the next scan while the device is in trouble. Old
    /// models also send one when the trouble is over.
    [[nodiscard]] std::optional<Status> trouble(const DeviceState& device,
                                                const DeviceProfile& profile);
    /// A message with this status and without a scan. It does not count as one of the scans.
    [[nodiscard]] std::string interruption(Status status);

    [[nodiscard]] int sent() const { return sent_; }
    [[nodiscard]] int interruptions() const { return interruptions_; }
    [[nodiscard]] bool has_at_least(int scans) const {
        return endless_ || sent_ + remaining_ >= scans;
    }
    /// The last of a counted stream has been made.
    [[nodiscard]] bool finished() const { return !endless_ && remaining_ == 0; }

  private:
    Subscription() = default;
    [[nodiscard]] Reply head(Status status) const;

    std::string echo_;
    std::size_t remaining_position_ = 0;  ///< in the echo: two digits
    StepWindow window_;
    DataFormat format_;
    int interval_ = 0;
    Uptime after_{};  ///< turns that begin later are taken
    int turns_to_skip_ = 0;
    int remaining_ = 0;
    int sent_ = 0;
    int interruptions_ = 0;
    bool endless_ = false;
    bool interrupted_ = false;  ///< by trouble
};

}  // namespace scipd::protocol
