// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One request or reply on the wire of a scanner, with what it means. A value; any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "sim/time.h"

namespace scipd::daemon {

struct WireEntry {
    std::string client;  ///< "tcp" or "tty"
    sim::Time told{};    ///< as people call the time
    bool from_client = false;
    std::string line;  ///< the request, or the echo of the reply
    std::size_t bytes = 0;
    std::string means;
    std::string status = {};    ///< empty: none
    std::string explains = {};  ///< what the status means here
    std::optional<std::int64_t> scan = std::nullopt;
};

using TakeEntry = std::function<void(WireEntry)>;

}  // namespace scipd::daemon
