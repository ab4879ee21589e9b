// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/fleet/kept_messages.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include <spdlog/spdlog.h>

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

std::string command_to_clear(const FleetConfig& config, const std::string& topic) {
    const BrokerAddress& at = config.broker;
    std::string command = "mosquitto_pub -h " + at.host + " -p " + std::to_string(at.port);
    const BrokerTls& tls = config.tls;
    if (at.tls)
        command += tls.ca.empty() ? " --capath /etc/ssl/certs" : " --cafile " + tls.ca.string();
    if (!tls.cert.empty()) command += " --cert " + tls.cert.string() + " --key " + tls.key.string();
    if (!config.user.name.empty()) command += " -u " + config.user.name + " -P PASSWORD";
    return command + " -q 1 -r -n -t " + topic;
}

std::string Troubles::told(const std::string& topic, const std::string& why) const {
    return topic + ": " + why + "; `" + command_to_clear(config_, topic) +
           "` takes the message away";
}

// Anybody who may write at the broker may do so ten thousand times a second.
bool Troubles::set(const std::string& topic, const std::string& why) {
    const auto known = why_.find(topic);
    if ((known == why_.end() ? "" : known->second) == why) return false;
    const auto now = std::chrono::steady_clock::now();
    if (why.empty()) {
        why_.erase(known);
        if (const auto others = gone_.admit(now))
            spdlog::info("{}: is well again{}", topic, *others);
    } else {
        why_[topic] = why;
        if (const auto others = told_.admit(now))
            spdlog::error("the broker keeps {}{}", told(topic, why), *others);
    }
    if (!why_.contains(first_)) first_ = why_.empty() ? "" : why_.begin()->first;
    std::string text = why_.empty() ? "" : told(first_, why_[first_]);
    if (why_.size() > 1) text += " (and others)";
    return std::exchange(text_, text) != text;
}

}  // namespace scipd::daemon
