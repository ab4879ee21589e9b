// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A client as its device knows it. For device.cpp alone. Lives on its shard.
#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "daemon/device/device.h"

namespace scipd::daemon {

/// One client, known to the device for as long as it lives.
class Device::ServedClient final : public Endpoint::Client {
  public:
    ServedClient(Device& device, std::function<void()> on_actions, protocol::LinkKind link)
        : Client(device.profile_, device.state_, link),
          on_actions_(std::move(on_actions)),
          kind_(link == protocol::LinkKind::tty ? DeviceLog::By::tty_client
                                                : DeviceLog::By::tcp_client),
          device_(device) {
        session().set_hook(device_.hook_);
        device_.clients_.push_back(this);
    }
    ServedClient(const ServedClient&) = delete;
    ServedClient& operator=(const ServedClient&) = delete;
    ~ServedClient() override {
        session().close();
        device_.told_.laser(device_.state_.laser_on(), DeviceLog::By::leaving_client);
        add(session().refused(), device_.counts_.refused);
        std::erase(device_.clients_, this);
    }

    void receive(std::string_view bytes) override {
        session().receive(bytes, device_.uptime());
        device_.serve_latest(*this);
    }
    [[nodiscard]] std::optional<sim::Time> wake_at() const override {
        const auto at = session().wake_at();
        if (!at) return std::nullopt;
        return device_.device_clock_.world_time(*at);
    }
    void wake() override {
        session().advance(device_.uptime());
        device_.serve_latest(*this);
    }

    /// Tells it that its session may have something to send.
    void tell() const { on_actions_(); }
    [[nodiscard]] DeviceLog::By kind() const { return kind_; }

  private:
    std::function<void()> on_actions_;
    DeviceLog::By kind_;
    Device& device_;
};

}  // namespace scipd::daemon
