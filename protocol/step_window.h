// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Which part of a scan a client asks for, and which values of it.
#pragma once

#include <optional>
#include <string_view>
#include <variant>

#include "protocol/device_profile.h"
#include "protocol/status.h"

namespace scipd::protocol {

/// What stands in the place of distances where the cluster of a URG-04LX is one of its undocumented
/// codes (qrk's c_urg). Two neighbouring steps show two things about the first of them.
enum class Contents {
    distances,
    distance_and_intensity,  ///< FF FE FD: the mean of two receivers, the second, the first
    intensity,               ///< EF EE ED: of every step, nothing else
    intensity_and_gain,      ///< DF DE DD
    gain,                    ///< DC DB: of every step
};

/// What a cluster of these two characters asks for; nothing where they are none of the codes.
[[nodiscard]] std::optional<Contents> parse_contents(std::string_view cluster);

struct StepWindow {
    int first = 0;  ///< both inclusive
    int last = 0;
    int cluster = 1;  ///< so many neighbouring steps give one value
    Contents contents = Contents::distances;
};

/// The ten digits of a window, or the first thing that is wrong with them in the order of its
/// status: 01 start, 02 end or 03 cluster is no number, 04 a step that the model does not have, 05
/// the end lies before the start.
[[nodiscard]] std::variant<StepWindow, Status> parse_step_window(std::string_view digits,
                                                                 const DeviceProfile& profile);

/// Digits only; nothing where there is anything else.
[[nodiscard]] std::optional<int> parse_digits(std::string_view digits);

}  // namespace scipd::protocol
