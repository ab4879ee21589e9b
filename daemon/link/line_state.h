// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a line does at present, by its configuration or by a fault. A value; any thread.
#pragma once

#include "daemon/config/link_config.h"

namespace scipd::daemon {

struct LineState {
    LinkConfig link;
    /// What is sent waits at the device's end, and leaves when this is over.
    bool stalled = false;
    /// What is sent either way is lost; the connection stays.
    bool dead = false;
    /// Nobody gets in: a TCP port refuses who connects, and there is no tty under its name. Who is
    /// connected stays.
    bool refuses = false;
    /// A tty hangs up, and there is none under its name; nothing to a TCP port.
    bool hung_up = false;

    bool operator==(const LineState&) const = default;
};

}  // namespace scipd::daemon
