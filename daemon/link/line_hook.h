// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Stands at the device's end of a line, for faults. Lives on its shard.
#pragma once

#include "protocol/action.h"

namespace scipd::daemon {

class Port;

class LineHook {
  public:
    virtual ~LineHook() = default;

    /// May change the bytes of a message that goes out; without bytes it is lost.
    virtual void leaving(protocol::Send& message) = 0;
    /// A client has connected to this port; a tty: has opened it.
    virtual void connected(Port& port) = 0;
};

}  // namespace scipd::daemon
