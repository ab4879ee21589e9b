// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where logs go and what their lines look like. Whoever logs never waits: a thread writes. Where
// that thread cannot keep up, or nobody reads, the oldest lines are lost; a line tells how many.
// Start and finish once, on the main thread, around all that logs.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace scipd::daemon {

/// A line of text begins with the time and the level; a line of JSON is a document. The journal of
/// systemd gets entries with fields, where standard error leads to it.
enum class LogFormat { text, json, journal };

/// Logs go to standard error; standard output belongs to the ready line. `level` is one of spdlog's
/// names; throws std::invalid_argument for another. At most so many lines wait to be written.
void start_logging(const std::string& level, LogFormat format = LogFormat::text,
                   std::size_t most_waiting = 4096);

/// There are sensors of these names, or there were: what is logged from here on may be about them.
void tell_log_of(const std::vector<std::string>& sensors);

/// Waits until all that was logged is written, but no longer than a second. False: standard error
/// does not take it, the thread still waits, and only std::_Exit() ends the program. Nothing is
/// logged from here on. Called again after false, it waits again.
bool finish_logging();

}  // namespace scipd::daemon
