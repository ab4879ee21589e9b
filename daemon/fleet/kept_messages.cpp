// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/fleet/kept_messages.h"

#include <algorithm>

namespace scipd::daemon {
namespace {

/// An empty text takes away what was kept.
void keep(std::map<std::string, std::string>& texts, const std::string& name,
          std::string_view text) {
    if (text.empty()) {
        texts.erase(name);
    } else {
        texts[name] = text;
    }
}

}  // namespace

void KeptMessages::take(const Topic& topic, std::string_view text) {
    switch (topic.kind) {
        case Topic::Kind::scene:
            scene.reset();
            if (auto note = parse_scene_note(text)) scene = *std::move(note);
            break;
        case Topic::Kind::daemon:
            daemons.erase(topic.name);
            if (auto note = parse_daemon_note(text)) daemons[topic.name] = *std::move(note);
            break;
        case Topic::Kind::model:
            keep(models, topic.name, text);
            break;
        case Topic::Kind::places:
            keep(places, topic.name, text);
            break;
        case Topic::Kind::poses:
        case Topic::Kind::marker:
        case Topic::Kind::time:
        case Topic::Kind::ack:
            break;
    }
}

const DaemonNote* KeptMessages::serving_other_than(const std::string& instance) const {
    const auto found = std::ranges::find_if(daemons, [&](const auto& entry) {
        return !entry.second.lost && entry.second.instance != instance;
    });
    return found == daemons.end() ? nullptr : &found->second;
}

}  // namespace scipd::daemon
