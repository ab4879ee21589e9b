// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// SCIP 1.1, which old models speak from power-up until a client sends SCIP2.0: one-letter commands,
// a status of one character, no sums. This file takes requests apart and puts replies together. The
// session decides whose laser and scans they concern.
#pragma once

#include <string>
#include <string_view>

#include "protocol/device_profile.h"
#include "protocol/device_state.h"
#include "protocol/scan_view.h"
#include "protocol/step_window.h"

namespace scipd::protocol {

struct Scip1Request {
    enum class Kind {
        version,       ///< V
        scan,          ///< G: start 3, end 3, cluster 2
        laser_off,     ///< L0
        laser_on,      ///< L1
        bit_rate,      ///< S: rate 6, 7 digits of no meaning
        choose_scip2,  ///< SCIP2.0
        unknown,       ///< anything else, also one of the above with wrong parameters
    };
    Kind kind = Kind::unknown;
    StepWindow window;
    int bit_rate = 0;
};

[[nodiscard]] Scip1Request parse_scip1(std::string_view line, const DeviceProfile& profile);

namespace scip1_status {
inline constexpr char ok = '0';
inline constexpr char unknown = 'E';
}  // namespace scip1_status

/// Does to the device what the request asks for, and returns the status of the reply. For a scan it
/// only says whether the device can make one.
[[nodiscard]] char operate_scip1(DeviceState& device, const Scip1Request& request, Uptime now);

[[nodiscard]] std::string scip1_reply(std::string_view echo, char status);
[[nodiscard]] std::string scip1_version(std::string_view echo, const DeviceProfile& profile,
                                        const DeviceState& device);
[[nodiscard]] std::string scip1_scan(std::string_view echo, const ScanView& scan,
                                     const StepWindow& window, const DeviceProfile& profile);

}  // namespace scipd::protocol
