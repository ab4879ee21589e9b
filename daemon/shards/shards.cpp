// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/shards/shards.h"

#include <chrono>
#include <memory>
#include <utility>
#include <vector>

#include <boost/asio/post.hpp>

namespace scipd::daemon {
namespace {

using Threads = std::vector<std::unique_ptr<ShardThread>>;
using Calls = std::vector<std::function<void()>>;

/// Where call_home() leaves what is called from a call that this thread makes beside others.
thread_local Calls* for_home = nullptr;

class LeavesForHome {
  public:
    explicit LeavesForHome(Calls& calls) { for_home = &calls; }
    LeavesForHome(const LeavesForHome&) = delete;
    LeavesForHome& operator=(const LeavesForHome&) = delete;
    ~LeavesForHome() { for_home = nullptr; }
};

/// Longer than sweeps take.
constexpr std::chrono::milliseconds in_time{10};
/// Longer than the picture of a camera should take.
constexpr std::chrono::milliseconds patience{250};
/// To do so few changes of a world takes less than to have a thread do it.
constexpr std::size_t few = 8;

/// Where some threads do not stand still in time, the others go on until these do: scans do not
/// wait for a picture on another thread. Once only, since the others may draw pictures as well.
void go_on_beside_the_late(const Threads& halted) {
    std::vector<ShardThread*> late;
    std::vector<ShardThread*> others;
    const auto soon = std::chrono::steady_clock::now() + in_time;
    for (const auto& thread : halted)
        (thread->wait_until_still_by(soon) ? others : late).push_back(thread.get());
    if (late.empty()) return;
    for (ShardThread* thread : others)
        thread->go_on();
    const auto then = std::chrono::steady_clock::now() + patience;
    for (ShardThread* thread : late)
        thread->wait_until_still_by(then);
    for (ShardThread* thread : others)
        thread->halt();
}

}  // namespace

Shards::Shards(const boost::asio::any_io_executor& home, World& world, WallClock& clock,
               std::size_t count)
    : home_(home), world_(world), home_shard_{0, home, world, clock} {
    if (count < 2) return;
    for (std::size_t number = 0; number < count; ++number)
        threads_.push_back(std::make_unique<ShardThread>(number, clock, home));
    world.on_change(
        [this](const World::Change& change, World::Haste haste) { tell(change, haste); });
}

Shards::Shards(const boost::asio::any_io_executor& home, World& world, SteppedClock& clock,
               std::size_t count)
    : home_(home), world_(world), home_shard_{0, home, world, clock} {
    if (count < 2) return;
    for (std::size_t number = 0; number < count; ++number)
        in_step_.push_back(std::make_unique<InStep>(number, home, clock));
    crew_ = std::make_unique<Crew>(count - 1);
    world.on_change(
        [this](const World::Change& change, World::Haste haste) { tell(change, haste); });
    clock.on_step([this] { flush(); });
    clock.on_beside(
        [this](const std::vector<SteppedClock::SlowCall>& calls) { call_side_by_side(calls); });
}

Shards::~Shards() {
    join();
}

Shard& Shards::at(std::size_t number) {
    if (!in_step_.empty()) return in_step_[number]->shard;
    return threads_.empty() ? home_shard_ : threads_[number]->shard();
}

void Shards::on_changed(const std::function<void(std::size_t)>& callback) {
    if (!in_step_.empty()) return void(changed_ = callback);
    if (threads_.empty()) return world_.on_placed([callback] { callback(0); });
    for (std::size_t number = 0; number < threads_.size(); ++number)
        threads_[number]->on_changed([callback, number] { callback(number); });
}

void Shards::still_on(std::size_t number, const std::function<void()>& act) {
    const auto errand = [&act] {
        const sim::MustBeQuick must_be_quick;
        act();
    };
    flush();
    if (threads_.empty() || joined_) return errand();
    ShardThread& thread = *threads_[number];
    if (halts_ > 0) return thread.catch_up(errand);
    thread.halt();
    wait_for(thread);
    thread.catch_up(errand);
    thread.go_on();
}

void Shards::call_home(std::function<void()> call) {
    if (for_home != nullptr) return for_home->push_back(std::move(call));
    if (threads_.empty()) return call();
    boost::asio::post(home_, std::move(call));
}

void Shards::tell(const World::Change& change, World::Haste haste) {
    if (joined_) return;
    if (haste == World::Haste::now) {
        // Poses are done by then. It is done alone: only they are copied side by side.
        return still([&] {
            kept_.push_back(change);
            flush();
            for (const auto& thread : threads_)
                thread->catch_up();
        });
    }
    kept_.push_back(change);
    if (kept_.size() > 1) return;
    boost::asio::post(home_, [this, alive = std::weak_ptr(alive_)] {
        if (!alive.expired()) flush();
    });
}

// What they leave for home is done in the order of the calls, whatever the threads do.
void Shards::call_side_by_side(const std::vector<SteppedClock::SlowCall>& calls) {
    std::vector<Calls> home(calls.size());
    std::vector<std::vector<std::size_t>> by_shard(size());
    for (std::size_t i = 0; i < calls.size(); ++i)
        by_shard[calls[i].shard].push_back(i);
    std::erase_if(by_shard, [](const auto& some) { return some.empty(); });
    std::vector<Crew::Job> jobs;
    for (const auto& some : by_shard) {
        jobs.emplace_back([&] {
            for (const std::size_t i : some) {
                const LeavesForHome leaves_for_home(home[i]);
                calls[i].call();
            }
        });
    }
    crew_->work(jobs);
    for (const Calls& some : home)
        std::ranges::for_each(some, [](const auto& one) { one(); });
}

void Shards::flush() {
    if (kept_.empty() || joined_) return;
    const auto changes =
        std::make_shared<const std::vector<World::Change>>(std::exchange(kept_, {}));
    for (const auto& thread : threads_)
        thread->tell(changes);
    change_in_step(*changes);
}

// Where there are many robots, poses come in bunches, and threads that are awake share the work.
void Shards::change_in_step(const std::vector<World::Change>& changes) {
    if (in_step_.empty()) return;
    std::vector<Crew::Job> jobs;
    for (const auto& there : in_step_) {
        jobs.emplace_back([&] {
            for (const World::Change& change : changes)
                change(there->world);
        });
    }
    if (changes.size() > few) {
        crew_->work(jobs);
    } else {
        std::ranges::for_each(jobs, [](const auto& job) { job(); });
    }
    for (std::size_t number = 0; number < in_step_.size(); ++number)
        changed_(number);
}

void Shards::halt() {
    flush();
    if (halts_++ > 0 || joined_) return;
    for (const auto& thread : threads_)
        thread->halt();
    go_on_beside_the_late(threads_);
    for (const auto& thread : threads_)
        wait_for(*thread);
}

void Shards::wait_for(ShardThread& thread) {
    thread.wait_until_still([&] { late_(thread.shard().number); });
}

void Shards::go_on() {
    if (--halts_ > 0 || joined_) return;
    for (const auto& thread : threads_)
        thread->go_on();
}

void Shards::join() {
    joined_ = true;
    for (const auto& thread : threads_)
        thread->join();
}

}  // namespace scipd::daemon
