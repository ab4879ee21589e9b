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
    /// A TCP port refuses who connects. A tty hangs up, and there is none under its name.
    bool refuses = false;
    /// A tty as above; nothing to a TCP port.
    bool hung_up = false;

    bool operator==(const LineState&) const = default;
};

}  // namespace scipd::daemon
