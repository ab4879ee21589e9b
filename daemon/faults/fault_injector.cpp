// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/faults/fault_injector.h"

#include <algorithm>
#include <utility>

#include "daemon/device/sweep.h"
#include "protocol/session.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;

// Faults that have ended are kept so that a test can ask what became of them.
constexpr std::size_t most_ended = 100;

// ScanLoop serves no turn that is later.
constexpr sim::Time longest_lag = 1s;

// So often is looked again for a scan that nobody asks for, and for a stamp before the first of the
// poses has come.
constexpr sim::Time look_again = 100ms;

// The keys of replies are none of scans.
constexpr std::uint64_t reply_keys = std::uint64_t{1} << 62U;

std::string_view code_of(const protocol::Request& request, const protocol::DeviceState& device) {
    const std::string_view echo = request.echo;
    if (device.speaks_scip1() && !echo.starts_with("SCIP")) return echo.substr(0, 1);
    return request.command == nullptr ? echo : request.command->code;
}

std::string first_line(const std::string& message) {
    return message.substr(0, message.find('\n'));
}

}  // namespace

FaultInjector::FaultInjector(Device& device, std::vector<Port*> ports, const LinkConfig& link,
                             Clock& clock)
    : link_(link),
      clock_(clock),
      site_(device, std::move(ports)),
      condition_(device),
      line_{link},
      alarm_(clock.make_idle_alarm()),
      end_alarm_(clock.make_alarm()),
      soon_(clock.make_alarm()) {}

FaultInjector::~FaultInjector() {
    stop_all();
    runs_.clear();
    tidy();
}

std::uint64_t FaultInjector::start(FaultPlan plan, std::uint64_t seed, std::optional<int> step) {
    look_at(moment());
    ++last_id_;
    // Two faults of one kind that have no seeds of their own must not do the same. The seeds of the
    // steps of a scenario differ already, and are the same whenever it is run.
    const std::uint64_t said_seed = plan.seed.value_or(step ? seed : seed + last_id_);
    // Nor must two scanners that one step is for.
    const std::uint64_t own_seed = said_seed ^ site_.device().chance(sim::Purpose::fault).sensor;
    runs_.push_back(std::make_unique<FaultRun>(site_, last_id_, std::move(plan), own_seed, step));
    advance();
    settle();
    return last_id_;
}

bool FaultInjector::stop(std::uint64_t id) {
    const auto found = std::ranges::find_if(
        runs_, [&](const auto& run) { return run->id() == id && !run->stopped(); });
    if (found == runs_.end()) return false;
    look_at(moment());
    (*found)->stop();
    settle();
    return true;
}

void FaultInjector::stop_all() {
    look_at(moment());
    for (const auto& run : runs_)
        run->stop();
    settle();
}

std::vector<FaultStatus> FaultInjector::list() const {
    std::vector<FaultStatus> list;
    for (const auto& run : runs_) {
        if (!run->stopped()) list.push_back(run->status());
    }
    return list;
}

template <class Act>
void FaultInjector::each_acting(Act act) {
    for (const auto& run : runs_) {
        if (FaultEffect* const effect = run->acting()) act(*effect, run->scene());
    }
}

// Turns are told late where the machine is slow, and not at all where nobody asks for scans. So
// while they are told the latest scan is the last one of them, whatever the time is.
FaultMoment FaultInjector::moment() const {
    const Device& device = site_.device();
    const sim::Time now = clock_.now();
    const std::int64_t latest = device.latest_turn();
    const bool told = latest >= 0 && device.wanted() && device.leaves(latest) + longest_lag > now;
    return {.scan = told ? latest : device.next_revolution() - 1,
            .time = now,
            .origin = clock_.origin()};
}

void FaultInjector::look_at(const FaultMoment& now) {
    site_.now = now;
    site_.key = static_cast<std::uint64_t>(now.scan);
    site_.request.clear();
    site_.stamped = site_.device().uptime();
}

void FaultInjector::look_at(const protocol::Send& message, std::uint64_t& replies) {
    site_.request = first_line(message.bytes);
    const bool scan = message.kind == protocol::Send::Kind::scan;
    site_.key = scan ? static_cast<std::uint64_t>(site_.now.scan) : reply_keys + ++replies;
}

std::optional<protocol::Status> FaultInjector::refuse(const protocol::Request& request) {
    look_at(moment());
    site_.request = request.echo;
    advance();
    for (const auto& run : runs_)
        run->meet_request(code_of(request, site_.device().state()));
    settle_soon();
    std::optional<protocol::Status> status;
    set_clock();
    each_acting([&](FaultEffect& effect, FaultScene& scene) {
        if (!status) status = effect.refuse(request, scene);
    });
    return status;
}

std::vector<protocol::Send> FaultInjector::leave(const protocol::Session& from,
                                                 protocol::Send message) {
    look_at(message, replies_);
    std::vector<protocol::Send> leaving;
    leaving.push_back(std::move(message));
    for (const auto& run : runs_) {
        if (FaultEffect* const effect = run->changing_messages())
            effect->messages(from, leaving, run->scene());
    }
    return leaving;
}

void FaultInjector::turn(std::int64_t revolution) {
    look_at({.scan = revolution,
             .serving = true,
             .time = site_.device().leaves(revolution),
             .origin = clock_.origin()});
    site_.stamped = site_.device().start_of(revolution);
    advance();
    settle();
    set_clock();
}

void FaultInjector::forget(const protocol::Session& session) {
    for (const auto& run : runs_) {
        if (FaultEffect* const effect = run->changing_messages()) effect->forget(session);
    }
}

void FaultInjector::set_clock() {
    std::optional<protocol::Uptime> shift;
    each_acting([&](FaultEffect& effect, FaultScene& scene) {
        if (const auto one = effect.clock_shift(scene)) shift = shift.value_or(0ns) + *one;
    });
    condition_.shift_clock(shift);
}

bool FaultInjector::serves(std::int64_t revolution) {
    site_.now.scan = revolution;
    site_.key = static_cast<std::uint64_t>(revolution);
    bool serves = true;
    each_acting(
        [&](FaultEffect& effect, FaultScene& scene) { serves = effect.serves(scene) && serves; });
    return serves;
}

std::vector<ReadingFault> FaultInjector::read(sim::Scan& scan, const sim::SensorSpec& optics) {
    site_.now.scan = scan.revolution;
    site_.key = static_cast<std::uint64_t>(scan.revolution);
    const std::uint64_t before = site_.log.last();
    each_acting([&](FaultEffect& effect, FaultScene& scene) { effect.read(scan, optics, scene); });
    std::vector<ReadingFault> changes;
    for (auto entry = site_.log.entries().rbegin();
         entry != site_.log.entries().rend() && entry->number > before; ++entry)
        changes.push_back({entry->kind, entry->what, entry->steps});
    return changes;
}

void FaultInjector::booted() {
    condition_.booted();
    for (const auto& run : runs_)
        run->meet_boot();
    settle_soon();
}

void FaultInjector::leaving(protocol::Send& message) {
    look_at(message, replies_sent_);
    each_acting([&](FaultEffect& effect, FaultScene& scene) { effect.bytes(message, scene); });
}

void FaultInjector::connected(Port& port) {
    look_at(moment());
    each_acting([&](FaultEffect& effect, FaultScene& scene) { effect.connected(port, scene); });
}

void FaultInjector::advance() {
    for (const auto& run : runs_)
        run->advance();
}

void FaultInjector::settle() {
    const auto settle_one = [](const auto& run) { return run->settle(); };
    // One may unsettle another: a boot ends those that last until then.
    while (std::ranges::any_of(runs_, settle_one))
        compose();
    tidy();
}

void FaultInjector::settle_soon() {
    const auto unsettled = [](const auto& run) { return run->unsettled(); };
    if (std::ranges::any_of(runs_, unsettled)) soon_->set(clock_.now(), [this] { settle(); });
}

void FaultInjector::compose() {
    LineState line{link_};
    PoseShift shift;
    DeviceCondition condition;
    sim::Time late{};
    each_acting([&](FaultEffect& effect, FaultScene&) {
        effect.line(line);
        effect.poses(shift);
        effect.condition(condition);
        late += effect.late();
    });
    condition_.set(condition);
    site_.device().set_late(late);
    set_clock();
    if (line != line_) {
        for (Port* const port : site_.ports)
            port->set_line(line);
    }
    line_ = line;
    if (shift != shift_) site_.device().shift_poses(shift);
    shift_ = shift;
}

bool FaultInjector::idle() const {
    return std::ranges::all_of(runs_, [](const auto& run) { return run->gone(); });
}

void FaultInjector::tidy() {
    if (std::exchange(hooked_, !idle()) != hooked_) {
        site_.device().set_hook(hooked_ ? this : nullptr);
        for (Port* const port : site_.ports)
            port->set_hook(hooked_ ? this : nullptr);
    }
    // What has been stopped may still keep a message back.
    std::erase_if(runs_, [](const auto& run) { return run->stopped() && run->gone(); });
    const auto gone = [](const auto& run) { return run->gone(); };
    while (std::ranges::count_if(runs_, gone) > static_cast<std::ptrdiff_t>(most_ended))
        runs_.erase(std::ranges::find_if(runs_, gone));
    wait();
}

void FaultInjector::wait() {
    std::optional<sim::Time> idle;
    std::optional<sim::Time> awaited;
    for (const auto& run : runs_) {
        std::optional<sim::Time>& at = run->awaited() ? awaited : idle;
        if (const auto next = next_look(run->schedule())) at = std::min(at.value_or(*next), *next);
    }
    const auto set = [this](Clock::Alarm& alarm, std::optional<sim::Time> at) {
        if (!at) return alarm.cancel();
        alarm.set(*at, [this] {
            look_at(moment());
            advance();
            settle();
        });
    };
    set(*alarm_, idle);
    set(*end_alarm_, awaited);
}

std::optional<sim::Time> FaultInjector::next_look(const FaultSchedule& schedule) const {
    const sim::Time now = clock_.now();
    if (const auto scan = schedule.next_scan())
        return std::max(site_.device().leaves(*scan), now + look_again);
    const sim::Time origin = clock_.origin();
    const auto time = schedule.next_time(origin);
    return time && origin == sim::Time{} ? std::min(*time, now + look_again) : time;
}

}  // namespace scipd::daemon
