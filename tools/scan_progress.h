// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <chrono>
#include <cstdint>
#include <iostream>
#include <string>
#include <utility>

#include "tools/safe_output.h"
#include "tools/terminal.h"

namespace scipd::tools {

/// Says on a terminal how many scans there are, five times a second.
class ScanProgress {
  public:
    /// What stands before the number.
    explicit ScanProgress(std::string before = {}) : before_(std::move(before)) {}
    ~ScanProgress() {
        if (shown_) SafeOutput::write_as_is(std::cerr, "\r\x1b[K");
    }
    ScanProgress(const ScanProgress&) = delete;
    ScanProgress& operator=(const ScanProgress&) = delete;

    void tell(std::uint64_t scans) {
        const auto now = std::chrono::steady_clock::now();
        if (!on_terminal_ || now < next_) return;
        next_ = now + std::chrono::milliseconds(200);
        shown_ = true;
        SafeOutput::write_as_is(std::cerr, "\r" + before_ + std::to_string(scans) + " scans");
        std::cerr.flush();
    }

  private:
    std::string before_;
    bool on_terminal_ = stderr_is_terminal();
    bool shown_ = false;
    std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now();
};

}  // namespace scipd::tools
