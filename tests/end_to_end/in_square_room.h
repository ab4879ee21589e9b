// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Helpers that the tests of a running scipd share.
#pragma once

#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/support/daemon_process.h"
#include "tests/support/scanner_wire.h"

namespace scipd::tests {

using Arguments = std::vector<std::string>;

/// A scanner at the origin. The range ahead (step 540 of a UST-10LX) is 3000 mm.
inline Arguments in_square_room(Arguments more) {
    Arguments arguments{"--scene", scene("square_room.sdf"), "--mount", "0,0,0.3,0,0,0"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

inline Arguments on_tcp(Arguments more = {"--accuracy", "ideal"}) {
    more.insert(more.end(), {"--tcp", "127.0.0.1:0", "--pty", "none"});
    return in_square_room(std::move(more));
}

inline Arguments on_tty(Arguments more = {"--accuracy", "ideal"}) {
    more.insert(more.end(), {"--tcp", "none", "--pty", "auto"});
    return in_square_room(std::move(more));
}

/// Checks again and again, for longer than scipd takes even on a busy machine.
inline bool eventually(const std::function<bool()>& condition) {
    using namespace std::chrono_literals;
    const auto end = std::chrono::steady_clock::now() + 20s;
    while (!condition()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(10ms);
    }
    return true;
}

/// The turns between the stamps of two scans, in whole ms. A UST-10LX turns once in 25.05 ms.
inline long turns_between(std::uint32_t earlier_ms, std::uint32_t later_ms) {
    return std::lround((static_cast<double>(later_ms) - earlier_ms) / 25.05);
}

/// An endless stream of the beam that looks ahead. Each scan is about 40 bytes.
inline const std::string stream_of_one_beam = "MD0540054000000";
inline const std::string stream_of_all_beams = "MD0000108000000";

}  // namespace scipd::tests
