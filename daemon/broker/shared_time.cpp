// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/broker/shared_time.h"

#include <spdlog/spdlog.h>

#include "daemon/broker/step.h"

namespace scipd::daemon {

// A step is acknowledged even where its time is refused: whoever leads would wait for ever.
void SharedTime::take(std::string_view text, PoseReceiver& receiver) {
    const auto step = parse_step(text);
    if (!step) return;
    receiver.take_step(step->lines, clock_);
    if (const auto time = lockstep_.world_time(step->time)) {
        lockstep_.begin_with(step->time);
        lockstep_.come_to(&clock_, *time, true);
    } else {
        spdlog::warn("step {} leaps too far for one run", step->number);
    }
    lockstep_.when_caught_up([this, alive = std::weak_ptr(alive_), said = acknowledgement(*step)] {
        if (!alive.expired()) link_.publish(ack_, said, {.surely = true});
    });
}

}  // namespace scipd::daemon
