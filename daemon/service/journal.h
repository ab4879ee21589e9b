// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The journal of systemd, whose entries have fields: people can ask it for one sensor alone. Any
// thread, as long as nobody changes the environment.
#pragma once

#include <string>

namespace scipd::daemon {

/// Whether what is written to this descriptor goes to the journal.
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
