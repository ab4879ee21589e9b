// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/check/played_model.h"

#include <utility>
#include <variant>

#include "protocol/ideal.h"

namespace scipd::tools::checks {
namespace {

/// Long enough for any reply; a scan takes two turns.
constexpr protocol::Uptime patience = std::chrono::milliseconds(500);
constexpr protocol::Uptime step = std::chrono::milliseconds(1);

bool answers(const std::string& message, const std::string& request) {
    return message.starts_with(request + "\n") && message.compare(request.size() + 1, 2, "99") != 0;
}

}  // namespace

PlayedModel::PlayedModel(protocol::DeviceProfile profile, protocol::LinkKind link)
    : profile_(protocol::ideal(std::move(profile))),
      session_(profile_, device_, link),
      distances_(static_cast<std::size_t>(profile_.last_step) + 1, 1000),
      intensities_(distances_.size(), 1000) {}

std::optional<std::string> PlayedModel::ask(const std::string& request) {
    session_.receive(request + "\n", now_);
    for (const protocol::Uptime end = now_ + patience; now_ < end; go_on()) {
        while (auto action = session_.next_action()) {
            auto* const sent = std::get_if<protocol::Send>(&*action);
            if (sent != nullptr && answers(sent->bytes, request)) return std::move(sent->bytes);
        }
    }
    return std::nullopt;
}

void PlayedModel::go_on() {
    now_ += step;
    session_.advance(now_);
    for (; turn_.start + profile_.scan_period <= now_; turn_.start += profile_.scan_period) {
        if (session_.turn_complete(turn_))
            session_.take({turn_, 0, distances_, intensities_}, now_);
    }
}

}  // namespace scipd::tools::checks
