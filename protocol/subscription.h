// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One running stream of scans: which turns it takes and how its messages look. Knows nothing of
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
    /// From a request of Parameters::scans that came in at `arrived`, when a turn took
    /// `scan_period`; or the first thing that is wrong with it: what parse_step_window() says, 06
    /// interval and 07 number of scans not numeric.
    static std::variant<Subscription, Status> from(const Request& request, Uptime arrived,
                                                   Uptime scan_period,
                                                   const DeviceProfile& profile);

    /// To be asked once for every turn whose last step has been fired since the acknowledgement, in
    /// order. With interval n, n turns are passed over before every one that is sent, and the first
    /// of them is the one under way when the request came in: a recorded UTM-30LX answers at the
    /// end of that turn and with interval 1 sends the very next one, 27 ms after its answer. A turn
    /// that began before the laser was on has nothing to show.
    [[nodiscard]] bool takes(const Turn& turn, Uptime laser_on_since);

    /// The message with this scan; counts it.
    [[nodiscard]] std::string message(const ScanView& scan, const DeviceState& device,
                                      const DeviceProfile& profile);

    /// What stands in the place of the next scan while the device is in trouble; old models say too
    /// when it is over.
    [[nodiscard]] std::optional<Status> trouble(const DeviceState& device,
                                                const DeviceProfile& profile);
    /// A message without a scan, where there is none to send; does not count.
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
