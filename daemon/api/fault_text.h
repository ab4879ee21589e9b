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

/// An entry as those who follow are told of it, with how many bytes and steps in the place of
/// which: {"sensor","n","id","kind","what","scan","request","time_s","bytes_n","steps_n"}
std::string fault_event(const std::string& sensor, const FaultLogEntry& entry);

/// {"name","state","steps":[{"step","sensor","id","kind","state","hits"}]}
Json scenario_document(const ScenarioStatus& scenario);

}  // namespace scipd::daemon
