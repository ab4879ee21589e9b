// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Listens at one port of a scanner, and tells each request and reply in words. Lives on its shard.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "daemon/device/device.h"
#include "daemon/link/wire_ear.h"
#include "daemon/wire/wire_entry.h"
#include "protocol/line_reader.h"
#include "protocol/request.h"
#include "protocol/scip1.h"
#include "protocol/status.h"

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
    void explain(const protocol::Request& echo, protocol::Status status, WireEntry& entry) const;
    void explain(const protocol::Scip1Request& echo, char status, WireEntry& entry) const;
    [[nodiscard]] std::optional<std::int64_t> latest_scan() const;

    Device& device_;
    std::string client_;
    TakeEntry take_;
    protocol::LineReader reader_;
};

}  // namespace scipd::daemon
