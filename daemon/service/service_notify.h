// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What scipd tells systemd about itself (sd_notify(3)). Without systemd ($NOTIFY_SOCKET is not set)
// nothing of this has any effect. A status is a line for people, as `systemctl status` shows it.
// Nobody waits here: if whoever listens does not read, it is told later. One thread at a time, and
// nobody changes the environment.
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace scipd::daemon::service_notify {

/// Whether anybody listens.
bool is_heard();

void status(const std::string& text);
/// The start may take this long from now, even if that is longer than the unit says.
void loading(const std::string& status, std::chrono::seconds patience);
void ready(const std::string& status);
void reloading(const std::string& status);
void stopping();
/// The latest of these that could not be told; to be called now and then.
void tell_again();

/// How long systemd waits for feed_watchdog() until it takes scipd for stuck; nothing: for ever.
std::optional<std::chrono::microseconds> watchdog();
void feed_watchdog();

}  // namespace scipd::daemon::service_notify
