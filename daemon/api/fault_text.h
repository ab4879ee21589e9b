// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Injected faults as JSON: the documents of the API, and the messages {"faults":[...]} to pages,
// each made once for all of them. Any thread; nothing shared.
#pragma once

#include <deque>
#include <memory>
#include <string>

#include "daemon/api/documents.h"
#include "daemon/faults/fault_kind.h"
#include "daemon/faults/fault_log.h"
#include "daemon/faults/scenario_run.h"
#include "daemon/http/backlog.h"

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

class FaultNews {
  public:
    /// Takes a fault_event(). Whether that made a message.
    bool add(const std::string& event);
    /// Makes a message of what has come since the last one, if anything has.
    bool look();

    /// Messages as of Backlog::from().
    [[nodiscard]] const Backlog::Message* from(Backlog::Number& number) const {
        return messages_.from(number);
    }
    [[nodiscard]] Backlog::Number end() const { return messages_.end(); }

  private:
    std::deque<std::string> events_;
    bool told_ = false;  ///< since the last look
    Backlog messages_{[](Backlog::Number, const Backlog::Message&) {}};
    std::shared_ptr<Backlog::Source> source_ = std::make_shared<Backlog::Source>();
};

}  // namespace scipd::daemon
