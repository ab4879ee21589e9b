// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Faults on purpose as JSON, as users get them. Any thread; nothing shared.
#pragma once

#include <string>

#include "daemon/api/documents.h"
#include "daemon/faults/fault_kind.h"
#include "daemon/faults/fault_log.h"
#include "daemon/faults/scenario_run.h"

namespace scipd::daemon {

/// {"id","kind","state","hits","scenario_step","fault": what was asked for}
Json fault_document(const FaultStatus& fault);

/// {"kind","layer","summary","members","momentary"}
Json kind_document(const FaultKind& kind);

/// {"n","id","kind","what","scan","request","time_s","bytes","steps"}
Json entry_document(const FaultLogEntry& entry);

/// The entries with a number greater than `since`, and which are kept:
/// {"entries":[..],"first","last"}
Json log_document(const FaultLog::Entries& entries, std::uint64_t since);

/// The message of /stream for an entry: {"fault":{"sensor", ..}}
std::string fault_message(const std::string& sensor, const FaultLogEntry& entry);

/// {"name","state","steps":[{"step","sensor","id","kind","state","hits"}]}
Json scenario_document(const ScenarioStatus& scenario);

}  // namespace scipd::daemon
