// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Anything that can happen to one device and its clients, in order, as made up by script_maker.h;
// performed on a Shell, where each client checks all that it is told. What a client must be told
// word for word is the business of dialogues.
#pragma once

#include <string>
#include <vector>

#include "protocol/device_profile.h"
#include "protocol/device_state.h"
#include "protocol/uptime.h"
#include "tests/protocol/shell.h"

namespace scipd::protocol {

struct Event {
    enum class Kind {
        say,          ///< a client's bytes come in
        wait,         ///< time passes
        boot,         ///< time passes until a boot that is due or under way is over
        hang_up,      ///< a client is gone; another takes its place
        trouble,      ///< something becomes the matter with the device, or passes
        power_cycle,  ///< it is off for no time
    };
    Kind kind = Kind::wait;
    int client = 0;
    std::string bytes;
    Uptime time{};
    Trouble trouble = Trouble::none;
};

struct Script {
    enum class PowerUp { ready, cold, scip1 };

    DeviceProfile profile;
    PowerUp power_up = PowerUp::ready;
    bool clock_wraps = false;  ///< a second from the start
    int clients = 1;
    std::vector<Event> events;
};

// For people.

/// An event a line.
[[nodiscard]] std::string to_text(const Script& script);
[[nodiscard]] std::string to_text(const Sent& message);

struct Outcome {
    std::vector<std::vector<Sent>> told;  ///< what each client was told
    std::string fault;  ///< the first thing that was wrong with it; empty: nothing
};

/// Waits at the end until all requests are answered; that they never are is a fault.
[[nodiscard]] Outcome perform(const Script& script);

}  // namespace scipd::protocol
