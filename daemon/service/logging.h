// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Log files, their lines as text or JSON, and the journal of systemd, whose entries have fields.
// Logging never blocks: a thread writes. If that thread cannot keep up, or nobody reads, the
// oldest lines are lost; a line tells how many. Start and finish once, on the main thread, around
// all that logs.
#pragma once

#include <chrono>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>
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

/// One entry of the log. A view that is good for one call.
struct LogEntry {
    std::chrono::system_clock::time_point time;
    std::string_view level;
    std::string_view message;
};

using Sensors = std::set<std::string, std::less<>>;

/// The sensor that a message is about: such messages begin with its name and a colon, and it is one
/// of these. Empty: there is none.
[[nodiscard]] std::string_view sensor_of(std::string_view message, const Sensors& sensors);

/// {"time","level","sensor","message"} without line end, in plain ASCII. The sensor is no part of
/// the message there. Messages that are about none have none.
[[nodiscard]] std::string json_log_line(const LogEntry& entry, const Sensors& sensors);

/// Returns true if bytes that are written to this descriptor go to the journal.
[[nodiscard]] bool leads_to_journal(int descriptor);

/// Severities as syslog(3) has them.
struct JournalEntry {
    int priority = 6;
    std::string message;
    std::string sensor;  ///< that it is about, for SCIPD_SENSOR; empty: none
};

/// May wait for the journal. False: it does not take the entry.
bool write_to_journal(const JournalEntry& entry);

}  // namespace scipd::daemon
