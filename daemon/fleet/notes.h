// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a daemon says of itself and of the world to the others, as JSON documents that the broker
// keeps. Values; any thread.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "sim/expected.h"

namespace scipd::daemon {

/// Which base world it is that all share.
struct SceneNote {
    std::string hash;      ///< of its content
    std::string by;        ///< the daemon that said so
    double begun_s = 0.0;  ///< since 1970: when its scripts began

    bool operator==(const SceneNote&) const = default;
};

/// One daemon of those that share the world.
struct DaemonNote {
    std::string name;
    std::string instance;   ///< differs whenever a daemon of that name is started
    bool lost = false;      ///< it went without a word
    bool in_steps = false;  ///< its time is that of the steps that somebody leads
    std::string host;
    int sensors = 0;
    std::map<std::string, std::string> bodies;  ///< by robot; empty where it has none
    std::string trouble;  ///< why its world differs from that of the others; empty: it does not

    bool operator==(const DaemonNote&) const = default;
};

/// What is told of it when it has gone without a word.
inline DaemonNote lost(DaemonNote who) {
    who.lost = true;
    return who;
}

std::string text_of(const SceneNote& note);
std::string text_of(const DaemonNote& note);
/// What is told of two base worlds that differ, of a world of this name.
std::string other_world(const SceneNote& theirs, const SceneNote& ours, const std::string& world);
sim::Expected<SceneNote> parse_scene_note(std::string_view text);
sim::Expected<DaemonNote> parse_daemon_note(std::string_view text);

}  // namespace scipd::daemon
