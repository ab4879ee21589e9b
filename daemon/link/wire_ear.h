// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Listens at the device's end of a line, and changes nothing. Lives on its shard.
#pragma once

#include <string_view>

#include "protocol/action.h"

namespace scipd::daemon {

class WireEar {
  public:
    virtual ~WireEar() = default;

    /// Another client is there.
    virtual void connected() = 0;
    /// Bytes of the client, as the device hears them.
    virtual void heard(std::string_view bytes) = 0;
    /// A message to the client, with what faults have made of it.
    virtual void said(const protocol::Send& message) = 0;
    /// That message is dropped: the client reads too slowly.
    virtual void dropped() = 0;
};

}  // namespace scipd::daemon
