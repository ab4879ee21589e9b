// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a page says over /view. Any thread; nothing shared.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "daemon/api/view_frame.h"
#include "sim/expected.h"

namespace scipd::daemon {

struct ViewRequest {
    using Scans = std::map<std::string, ViewDepth>;

    std::optional<Scans> scans;        ///< of these sensors it wants scans from now on
    std::optional<std::uint32_t> ack;  ///< the frame of this number is drawn
    bool ack_poses = false;            ///< and so are the poses
};

sim::Expected<ViewRequest> parse_view_request(std::string_view text);

}  // namespace scipd::daemon
