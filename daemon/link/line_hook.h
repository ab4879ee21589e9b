// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The device's end of a line: a hook for faults, an observer of the traffic, and the state of the
// line by its configuration or by a fault. They live on the shard of the line.
#pragma once

#include <string_view>

#include "daemon/config/link_config.h"
#include "protocol/action.h"

namespace scipd::daemon {

class Port;

/// The place of faults at the device's end of a line.
class LineHook {
  public:
    virtual ~LineHook() = default;

    /// May change the bytes of a message that goes out; without bytes it is lost.
    virtual void leaving(protocol::Send& message) = 0;
    /// A client has connected to this port; a tty: has opened it.
    virtual void connected(Port& port) = 0;
};

/// Observes the traffic at the device's end of a line, and changes nothing.
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

/// The present state of a line.
struct LineState {
    LinkConfig link;
    /// Bytes that are sent wait at the device's end, and leave when this is over.
    bool stalled = false;
    /// Bytes that are sent either way are lost; the connection stays.
    bool dead = false;
    /// A TCP port refuses new clients, and there is no tty under its name. A client that is
    /// connected stays.
    bool refuses = false;
    /// A tty hangs up, and there is none under its name; nothing to a TCP port.
    bool hung_up = false;

    bool operator==(const LineState&) const = default;
};

}  // namespace scipd::daemon
