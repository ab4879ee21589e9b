// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The messages that a broker keeps of a world, for those who come later, and those of them that
// this daemon cannot follow. One thread.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "daemon/config/fleet_config.h"
#include "daemon/fleet/notes.h"
#include "daemon/fleet/topics.h"
#include "daemon/limits/throttle.h"

namespace scipd::daemon {

/// Texts that make no sense are left out, but for those of models.
struct KeptMessages {
    std::optional<SceneNote> scene;
    std::map<std::string, DaemonNote> daemons;  ///< by name
    std::map<std::string, std::string> models;  ///< what parse_model_message() reads
    std::map<std::string, std::string> places;  ///< pose lines, by sender

    void take(const Topic& topic, std::string_view text);

    /// The first daemon that serves, other than that instance; null where there is none.
    [[nodiscard]] const DaemonNote* serving_other_than(const std::string& instance) const;
};

/// The command that has the broker keep nothing under this topic.
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
