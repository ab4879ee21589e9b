// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a sensor finds where it lives: a thread's event loop, with a clock and a world of that
// thread. A view; whoever holds it uses it on that thread, or while all shards stand still.
#pragma once

#include <cstddef>

#include <boost/asio/any_io_executor.hpp>

#include "daemon/clock/clock.h"
#include "daemon/world/world.h"

namespace scipd::daemon {

struct Shard {
    std::size_t number = 0;
    boost::asio::any_io_executor executor;
    World& world;
    Clock& clock;
};

}  // namespace scipd::daemon
