// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a child process may take, and how it ends. A value.
#pragma once

#include <chrono>
#include <cstddef>
#include <stop_token>
#include <string>

namespace scipd::sim {

struct Confines {
    std::chrono::seconds processor_time;
    std::size_t memory_bytes;  ///< on top of what the process uses when it begins
    std::chrono::milliseconds wall_time = std::chrono::minutes{2};
    std::stop_token stop = {};  ///< requested when nobody waits any more
    /// Advice at the end of the message that the work took too much: "KEY allows more".
    std::string more_memory = {};
    std::string more_time = {};
};

/// The exit status of a child that has written why it failed in place of its answer. If all went
/// well, it is 0.
inline constexpr int failed_with_words = 1;

}  // namespace scipd::sim
