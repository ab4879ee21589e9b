// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What this daemon cannot go along with of the messages that the broker keeps, by topic: a daemon
// that runs, or starts, does without them and says so until they are gone. Lives on the I/O thread.
#pragma once

#include <map>
#include <string>

#include "daemon/config/fleet_config.h"
#include "daemon/limits/throttle.h"

namespace scipd::daemon {

/// What to type so that the broker keeps nothing under this topic.
std::string command_to_clear(const FleetConfig& config, const std::string& topic);

class Troubles {
  public:
    explicit Troubles(FleetConfig config) : config_(std::move(config)) {}

    /// Empty: all is well with this topic. Tells the log. Returns whether text() has changed.
    bool set(const std::string& topic, const std::string& why);
    /// Tells of one trouble, with what to do about it, and whether there are others; empty: none.
    /// Others that come and go do not change it: all daemons hear of each change.
    [[nodiscard]] const std::string& text() const { return text_; }

  private:
    [[nodiscard]] std::string told(const std::string& topic, const std::string& why) const;

    const FleetConfig config_;
    std::map<std::string, std::string> why_;  ///< by topic
    std::string first_;                       ///< the topic that is told
    std::string text_;
    Throttle told_;
    Throttle gone_;
};

}  // namespace scipd::daemon
