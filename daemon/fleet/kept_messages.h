// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a broker keeps of a world, for those who come later. Gathered from its messages; a value.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "daemon/fleet/notes.h"
#include "daemon/fleet/topics.h"

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

}  // namespace scipd::daemon
