// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/fleet/shared_time.h"

#include <chrono>

#include <spdlog/spdlog.h>

#include "daemon/fleet/pose_frame.h"
#include "sim/text/quote.h"

namespace scipd::daemon {

// A step is acknowledged even where its time is refused: whoever leads would wait for ever.
void SharedTime::take(std::string_view text, PoseReceiver& receiver) {
    const auto step = parse_step(text);
    if (!step) return;
    if (const auto time = intake_.take_step(step->time, clock_)) {
        receiver.take_step(step->lines, *time);
        lockstep_.come_to(&clock_, *time, true);
    } else if (const auto others = refusals_told_.admit(std::chrono::steady_clock::now())) {
        spdlog::warn("step {} from {} refused: {}{}", step->number, sim::printable(step->from),
                     time.error().why, *others);
    }
    lockstep_.when_caught_up([this, alive = std::weak_ptr(alive_), said = acknowledgement(*step)] {
        if (!alive.expired()) link_.publish(ack_, said, {.surely = true});
    });
}

}  // namespace scipd::daemon
