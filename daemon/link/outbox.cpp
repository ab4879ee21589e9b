// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/link/outbox.h"

namespace scipd::daemon {

bool Outbox::push(protocol::Send message, sim::Time now) {
    // A message that is alone has room, however long it is.
    const std::size_t waiting = line_.bytes();
    const bool fits = waiting == 0 || waiting + message.bytes.size() <= capacity_bytes_;
    if (message.kind == protocol::Send::Kind::scan && !fits) return false;
    line_.send(std::move(message.bytes), now);
    return true;
}

}  // namespace scipd::daemon
