// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/poses/lockstep.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include <boost/asio/post.hpp>

namespace scipd::daemon {
namespace {

// So many calls are made before the event loop turns to the sockets again.
constexpr std::size_t calls_in_one_go = 64;

using Seconds = std::chrono::duration<double>;
// With these limits the difference of any two times of the world fits into a Time.
constexpr Seconds farthest{4.5e9};
constexpr Seconds farthest_origin{9.2e9};

// In floating point, since the difference of two stamps may not fit into a Time.
bool too_far(sim::Time a, sim::Time b, Seconds limit = farthest) {
    return std::abs(Seconds(a).count() - Seconds(b).count()) > limit.count();
}

}  // namespace

Lockstep::Lockstep(boost::asio::any_io_executor executor) : executor_(std::move(executor)) {
    clock_.on_released([this] { go_on(); });
    clock_.on_awaited([this] { go_on(); });
}

std::optional<sim::Time> Lockstep::world_time(sim::Time stamp) const {
    const sim::Time origin = origin_with(stamp);
    if (too_far(stamp, origin)) return std::nullopt;
    return stamp - origin;
}

void Lockstep::begin_with(sim::Time stamp) {
    clock_.set_origin(origin_with(stamp));
    begun_ = true;
}

std::optional<sim::Time> Lockstep::time_anew(Stream stream, sim::Time first,
                                             sim::Time stamp) const {
    const sim::Time from = come_to(stream);
    if (too_far(first, from, farthest_origin) || too_far(stamp, first, farthest - from))
        return std::nullopt;
    return from + (stamp - first);
}

void Lockstep::begin_anew_with(Stream stream, sim::Time first) {
    clock_.set_origin(first - come_to(stream));
    begun_ = true;
}

// The stamps of a trajectory count from its own beginning. Where it has moved time on before the
// first stamp came, the clock has its origin already.
sim::Time Lockstep::origin_with(sim::Time stamp) const {
    return begun_ || clock_.now() > sim::Time{} ? clock_.origin() : stamp;
}

void Lockstep::remove(Stream stream) {
    const auto gone = streams_.extract(stream);
    if (gone && gone.mapped().latest) come_to(stream, *gone.mapped().latest, true);
    go_on();
}

const Lockstep::Progress& Lockstep::progress(Stream stream) const {
    const auto known = streams_.find(stream);
    return known != streams_.end() ? known->second : others_;
}

sim::Time Lockstep::come_to(Stream stream) const {
    return std::max(progress(stream).latest.value_or(clock_.now()), clock_.now());
}

void Lockstep::come_to(Stream stream, sim::Time time, bool said_all) {
    const auto known = streams_.find(stream);
    Progress& progress = known != streams_.end() ? known->second : others_;
    if (progress.latest && time > *progress.latest) progress.known = progress.latest;
    progress.latest = std::max(progress.latest.value_or(time), time);
    if (said_all) progress.known = progress.latest;
    go_on();
}

void Lockstep::when_caught_up(Call call) {
    for_caught_up_.push_back(std::move(call));
    go_on();
}

void Lockstep::when_awaited(Call call) {
    for_awaited_.push_back(std::move(call));
    go_on();
}

sim::Time Lockstep::target() const {
    if (streams_.empty()) return others_.known.value_or(clock_.now());
    sim::Time least = sim::Time::max();
    for (const auto& [stream, progress] : streams_)
        least = std::min(least, progress.known.value_or(clock_.now()));
    return least;
}

// Posted, so that nothing happens inside the call of a stream that says how far it has come.
void Lockstep::go_on() {
    if (std::exchange(at_work_, true)) return;
    boost::asio::post(executor_, [this, alive = std::weak_ptr(alive_)] {
        if (alive.expired()) return;
        at_work_ = false;
        work();
    });
}

void Lockstep::work() {
    for (std::size_t calls = 0; calls < calls_in_one_go;) {
        if (clock_.held()) return;  // goes on when it is released
        const std::size_t made = clock_.step(target());
        if (made == 0) return call_whoever_waits();
        calls += made;
    }
    go_on();
}

void Lockstep::call_whoever_waits() {
    for (const Call& call : std::exchange(for_caught_up_, {}))
        call();
    if (!clock_.awaited()) return;
    for (const Call& call : std::exchange(for_awaited_, {}))
        call();
}

}  // namespace scipd::daemon
