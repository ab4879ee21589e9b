// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/api/fault_text.h"

#include <cstddef>
#include <utility>

namespace scipd::daemon {
namespace {

/// All but where it was.
Json head_document(const FaultLogEntry& entry) {
    return {{"n", entry.number},
            {"id", entry.id},
            {"kind", entry.kind},
            {"what", entry.what},
            {"scan", entry.scan},
            {"request", entry.request.empty() ? Json(nullptr) : Json(entry.request)},
            {"time_s", seconds(entry.told)}};
}

/// In one message: nobody reads more between two looks. Their numbers tell what is left out.
constexpr std::size_t most_events = 64;

}  // namespace

Json fault_document(const FaultStatus& fault) {
    return {{"id", fault.id},
            {"kind", fault.kind},
            {"state", fault.state},
            {"hits", fault.hits},
            {"scenario_step", fault.scenario_step ? Json(*fault.scenario_step) : Json(nullptr)},
            {"fault", Json::parse(fault.said)}};
}

Json kind_document(const FaultKind& kind) {
    return {{"kind", kind.name},
            {"layer", kind.layer},
            {"summary", kind.summary},
            {"members", kind.keys()},
            {"momentary", kind.momentary}};
}

Json entry_document(const FaultLogEntry& entry) {
    Json document = head_document(entry);
    document["bytes"] = entry.bytes;
    document["steps"] = entry.steps;
    return document;
}

Json log_document(const FaultLog::Entries& entries, std::uint64_t since) {
    Json documents = Json::array();
    for (const FaultLogEntry& entry : entries) {
        if (entry.number > since) documents.push_back(entry_document(entry));
    }
    const bool empty = entries.empty();
    return {{"entries", std::move(documents)},
            {"first", empty ? 0 : entries.front().number},
            {"last", empty ? 0 : entries.back().number}};
}

std::string fault_event(const std::string& sensor, const FaultLogEntry& entry) {
    Json event{{"sensor", sensor}};
    event.update(head_document(entry));
    event["bytes_n"] = entry.bytes.size();
    event["steps_n"] = entry.steps.size();
    return text_of(event);
}

Json scenario_document(const ScenarioStatus& scenario) {
    Json steps = Json::array();
    for (const auto& [step, sensor, fault] : scenario.steps) {
        steps.push_back({{"step", step},
                         {"sensor", sensor},
                         {"id", fault.id},
                         {"kind", fault.kind},
                         {"state", fault.state},
                         {"hits", fault.hits}});
    }
    return {{"name", scenario.name}, {"state", scenario.state}, {"steps", std::move(steps)}};
}

bool FaultNews::add(const std::string& event) {
    events_.push_back(event);
    if (events_.size() > most_events) events_.pop_front();
    return !told_ && look();
}

bool FaultNews::look() {
    told_ = !events_.empty();
    if (!told_) return false;
    std::string message;
    for (const std::string& event : std::exchange(events_, {}))
        message += (message.empty() ? R"({"faults":[)" : ",") + event;
    messages_.add(source_, message + "]}");
    return true;
}

}  // namespace scipd::daemon
