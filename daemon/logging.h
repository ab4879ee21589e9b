// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where logs go and what their lines look like. Whoever logs never waits: a thread writes, and
// where it cannot keep up, or nobody reads, the oldest lines are lost, counted and told. Start and
// finish once, on the main thread, around all that logs.
#pragma once

#include <cstddef>
#include <string>

namespace scipd::daemon {

/// Logs go to standard error, each line beginning with the time and the level; standard output
/// belongs to the ready line. `level` is one of spdlog's names; throws std::invalid_argument for
/// another. At most so many lines wait to be written.
void start_logging(const std::string& level, std::size_t most_waiting = 4096);

/// Waits until all is written that was logged, but no longer than a second: false where standard
/// error does not take it. Then only std::_Exit() ends the program, for the thread still waits.
/// Nothing is logged from here on; called again it waits again where it waited in vain.
bool finish_logging();

}  // namespace scipd::daemon
