// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Listens at one port of a scanner, and tells each request and reply in words. Lives on its shard.
#pragma once

#include <string>
#include <string_view>

#include "daemon/device/device.h"
#include "daemon/link/wire_ear.h"
#include "daemon/wire/wire_entry.h"
#include "protocol/line_reader.h"

namespace scipd::daemon {

class WireListener : public WireEar {
  public:
    /// `device` must outlive it.
    WireListener(Device& device, std::string client, TakeEntry take);

    void connected() override { reader_.forget(); }
    void heard(std::string_view bytes) override;
    void said(const protocol::Send& message) override;
    void dropped() override;

  private:
    [[nodiscard]] WireEntry begin(std::string_view line, std::size_t bytes) const;

    Device& device_;
    std::string client_;
    TakeEntry take_;
    protocol::LineReader reader_;
};

}  // namespace scipd::daemon
