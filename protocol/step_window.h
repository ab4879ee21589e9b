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

/// What the values of a window are. A URG-04LX knows undocumented codes in the place of the cluster
/// (qrk's c_urg), which ask for something else than distances. Where two things are asked for, each
/// pair of neighbouring steps shows both of the first step.
enum class Contents {
    distances,
    distance_and_intensity,  ///< FF FE FD: the mean of two receivers, the second, the first
    intensity,               ///< EF EE ED: of every step, nothing else
    intensity_and_gain,      ///< DF DE DD
    gain,                    ///< DC DB: of every step
};

/// What a cluster of these two characters asks for. Nothing: they are none of the codes.
[[nodiscard]] std::optional<Contents> parse_contents(std::string_view cluster);

struct StepWindow {
    int first = 0;  ///< both inclusive
    int last = 0;
    int cluster = 1;  ///< so many neighbouring steps give one value
    Contents contents = Contents::distances;
};

/// The ten digits of a window, or the status (of status::scan) of the first thing that is wrong
/// with them.
[[nodiscard]] std::variant<StepWindow, Status> parse_step_window(std::string_view digits,
                                                                 const DeviceProfile& profile);

/// The number that these digits make. Nothing: there are other characters.
[[nodiscard]] std::optional<int> parse_digits(std::string_view digits);

}  // namespace scipd::protocol
