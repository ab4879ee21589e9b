// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What has gone over a link, in numbers that only grow. A value; one thread.
#pragma once

#include <cstdint>

namespace scipd::daemon {

struct LinkCounts {
    std::uint64_t lost_scans = 0;  ///< that clients read too slowly for
    std::uint64_t sent_bytes = 0;  ///< that the kernel has taken for a client

    LinkCounts& operator+=(const LinkCounts& more) {
        lost_scans += more.lost_scans;
        sent_bytes += more.sent_bytes;
        return *this;
    }
};

}  // namespace scipd::daemon
