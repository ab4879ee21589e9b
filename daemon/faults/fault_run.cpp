// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/faults/fault_run.h"

#include <spdlog/spdlog.h>

#include "daemon/faults/fault_kind.h"
#include "sim/random.h"

namespace scipd::daemon {
namespace {

std::string_view name_of(FaultSchedule::Phase phase) {
    if (phase == FaultSchedule::Phase::waiting) return "waiting";
    return phase == FaultSchedule::Phase::active ? "active" : "ended";
}

}  // namespace

FaultRun::FaultRun(FaultSite& site, std::uint64_t id, FaultPlan plan, std::uint64_t seed,
                   std::optional<int> step)
    : site_(site),
      id_(id),
      plan_(std::move(plan)),
      seed_(seed),
      step_(step),
      schedule_(plan_, seed_, site.now) {}

FaultStatus FaultRun::status() const {
    return {.id = id_,
            .kind = std::string(plan_.kind->name),
            .state = std::string(name_of(schedule_.phase())),
            .hits = hits_,
            .said = plan_.said,
            .scenario_step = step_};
}

bool FaultRun::gone() const {
    return schedule_.phase() == FaultSchedule::Phase::ended && !unsettled() && !last_;
}

void FaultRun::advance() {
    // Who waited for what is kept back has gone, or has got it.
    if (last_ && (!last_->holds() || !site_.driven())) last_ = nullptr;
    if (schedule_.over(site_.now)) end();
    if (schedule_.due(site_.now)) begin();
    if (schedule_.over(site_.now)) end();
}

void FaultRun::meet_request(std::string_view command) {
    if (schedule_.begins_with(command)) {
        begin();
        advance();
    } else if (command != "RB" && schedule_.ends_with(command)) {
        end();
    }
}

void FaultRun::meet_boot() {
    if (schedule_.ends_with_boot()) return end();
    if (acting_) acting_->booted(*this);
}

void FaultRun::stop() {
    if (schedule_.phase() == FaultSchedule::Phase::active) end();
    schedule_.stop();
    stopped_ = true;
}

void FaultRun::begin() {
    drove_ = site_.driven();
    schedule_.begin(site_.now);
    acting_ = plan_.make();
    changes_.push_back({acting_, true});
    log(spdlog::level::info, {.what = "begins"});
}

void FaultRun::end() {
    schedule_.end(site_.now);
    if (acting_->holds()) last_ = acting_;
    changes_.push_back({std::move(acting_), false});
    acting_ = nullptr;
}

bool FaultRun::settle() {
    // An effect may have the device boot, with which others end.
    bool settled = false;
    while (!changes_.empty()) {
        const Change change = std::move(changes_.front());
        changes_.erase(changes_.begin());
        settled = true;
        if (change.begins) {
            change.effect->begin(*this);
        } else {
            change.effect->end(*this);
            log(spdlog::level::info, {.what = "ends"});
        }
    }
    return settled;
}

double FaultRun::chance(std::uint32_t n) const {
    const sim::Chance numbers({.seed = seed_, .scan = site_.key, .purpose = sim::Purpose::fault});
    return 0.5 + 0.5 * numbers.even(n);
}

void FaultRun::touched(FaultTouch touch) {
    ++hits_;
    site_.log.count_hit();
    log(spdlog::level::debug, std::move(touch));
}

void FaultRun::log(spdlog::level::level_enum level, FaultTouch touch) {
    spdlog::log(level, "{}: fault {}, {}, at scan {}: {}", site_.name, id_, plan_.kind->name,
                site_.now.scan, touch.what);
    site_.log.add({.id = id_,
                   .kind = std::string(plan_.kind->name),
                   .what = std::move(touch.what),
                   .scan = site_.now.scan,
                   .request = site_.request,
                   .told = site_.now.origin + site_.now.time,
                   .bytes = std::move(touch.bytes),
                   .steps = std::move(touch.steps)});
}

}  // namespace scipd::daemon
