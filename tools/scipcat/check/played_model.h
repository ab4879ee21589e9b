// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A model of scipd that answers in this process, without a socket or a clock: what a scanner with
// that firmware would say. Its scans hold one distance. One thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocol/device_profile.h"
#include "protocol/device_state.h"
#include "protocol/session.h"

namespace scipd::tools::checks {

class PlayedModel {
  public:
    PlayedModel(protocol::DeviceProfile profile, protocol::LinkKind link);

    /// The whole reply to a request. Nothing: it stays silent.
    [[nodiscard]] std::optional<std::string> ask(const std::string& request);

  private:
    void go_on();

    protocol::DeviceProfile profile_;
    protocol::DeviceState device_;
    protocol::Session session_;
    std::vector<std::uint32_t> distances_;
    std::vector<std::uint32_t> intensities_;
    protocol::Uptime now_{};
    protocol::Turn turn_{};
};

}  // namespace scipd::tools::checks
