// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/device/client.h"

#include <utility>

namespace scipd::daemon {

Client::Client(Device& device, std::function<void()> on_actions, protocol::LinkKind link)
    : device_(device),
      session_(device.profile_, device.state_, link),
      on_actions_(std::move(on_actions)) {
    device_.add(*this);
}

Client::~Client() {
    device_.remove(*this);
}

void Client::receive(std::string_view bytes) {
    session_.receive(bytes, device_.uptime());
    device_.serve_latest(*this);
}

std::optional<sim::Time> Client::wake_at() const {
    const auto at = session_.wake_at();
    if (!at) return std::nullopt;
    return device_.device_clock_.world_time(*at);
}

void Client::wake() {
    session_.advance(device_.uptime());
    device_.serve_latest(*this);
}

}  // namespace scipd::daemon
