// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A scanner for programs under test: protocol::Session behind a TCP port of 127.0.0.1 and a pty,
// with distances from a function. It has one thread, no simulation and no daemon.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>

#include "protocol/device_profile.h"

namespace scipd::tests {

struct Reading {
    std::uint32_t distance_mm = 0;
    std::uint32_t intensity = 0;
};

class LoopbackScanner {
  public:
    /// Its thread calls `reading` once for each step from 0 to the last.
    LoopbackScanner(protocol::DeviceProfile profile, std::function<Reading(int step)> reading);
    ~LoopbackScanner();
    LoopbackScanner(const LoopbackScanner&) = delete;
    LoopbackScanner& operator=(const LoopbackScanner&) = delete;

    [[nodiscard]] const protocol::DeviceProfile& profile() const { return profile_; }
    /// tcp://127.0.0.1:PORT
    [[nodiscard]] std::string tcp_target() const;
    [[nodiscard]] const std::string& tty() const { return tty_; }

  private:
    void serve();

    protocol::DeviceProfile profile_;
    std::function<Reading(int)> reading_;
    int listener_ = -1;
    int pty_ = -1;
    int pty_kept_open_ = -1;  ///< without it the pty reads EIO between two clients
    int port_ = 0;
    std::string tty_;
    std::atomic<bool> stop_ = false;
    std::thread thread_;
};

}  // namespace scipd::tests
