// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How it stands with a world that daemons share by way of a broker. A value; any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace scipd::daemon {

/// The world that this daemon shares with others.
struct SharedStatus {
    std::string broker;  ///< "mqtt://127.0.0.1:1883"
    std::string world;
    std::string name;  ///< of this daemon
    bool connected = false;
    std::uint64_t daemons = 0;           ///< others that serve
    std::optional<std::string> trouble;  ///< with the others: what, why, and what to do
    std::uint64_t frames_dropped = 0;    ///< of poses, since somebody was too slow
};

}  // namespace scipd::daemon
