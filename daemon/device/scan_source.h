// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A sensor as ScanLoop sees it, which waits for the sensor's instants: it makes scans at instants
// of its own as long as somebody wants them. Device and StaringSensor implement it. Lives on its
// shard.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "sim/time.h"

namespace scipd::daemon {

class ScanSource {
  public:
    ScanSource() = default;
    ScanSource(const ScanSource&) = delete;
    ScanSource& operator=(const ScanSource&) = delete;
    virtual ~ScanSource() = default;

    /// The sensor's, as people call it.
    [[nodiscard]] virtual const std::string& name() const = 0;

    /// Whether somebody waits for scans.
    [[nodiscard]] bool wanted() const { return driven() || watched(); }
    /// Whether a driver waits for scans.
    [[nodiscard]] virtual bool driven() const = 0;
    /// Whether somebody sees every scan, whatever drivers want.
    [[nodiscard]] virtual bool watched() const = 0;
    /// The sensor calls this when wanted() may have become true.
    virtual void on_wanted(std::function<void()> callback) = 0;

    /// To be called before turns are waited for, where nobody wanted scans until now.
    virtual void resume() {}
    /// The first revolution whose scan has not left yet.
    [[nodiscard]] virtual std::int64_t next_revolution() const = 0;
    /// When its scan leaves.
    [[nodiscard]] virtual sim::Time leaves(std::int64_t revolution) const = 0;
    /// How long a scan may wait for poses.
    [[nodiscard]] virtual sim::Time patience() const = 0;
    /// Whether the scan need not wait for poses any more.
    [[nodiscard]] virtual bool poses_known(std::int64_t revolution) const = 0;
    /// Whether turn_complete() depends on no other sensor and changes nothing of theirs, so that it
    /// may be called on any thread while nobody else uses this shard.
    [[nodiscard]] virtual bool stands_alone() const { return false; }
    /// To be called once for each revolution, in order, at or after leaves(): serves everyone who
    /// takes it.
    virtual void turn_complete(std::int64_t revolution) = 0;
};

}  // namespace scipd::daemon
