// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The conversation of all scanners with their clients, heard from the start of scipd on. Any
// thread.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <string>
#include <vector>

#include "testing/listener.h"
#include "testing/scipd_parts.h"

namespace scipd::testing {

class WireLog {
  public:
    WireLog(const std::string& control, const std::vector<std::string>& scanners);

    [[nodiscard]] std::vector<WireMessage> messages() const;
    /// The first request that begins so. Throws ScipdError.
    [[nodiscard]] WireMessage wait_for(const std::string& request,
                                       std::chrono::milliseconds timeout) const;
    void catch_up() const;

  private:
    void hear(const std::string& text);

    mutable std::mutex mutex_;
    mutable std::condition_variable news_;
    std::deque<WireMessage> messages_;
    std::deque<Listener> listeners_;  ///< last, as their threads use the others
};

}  // namespace scipd::testing
