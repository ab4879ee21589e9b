// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/shards/shards.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <utility>

#include <boost/asio/post.hpp>

namespace scipd::daemon {
namespace {

/// Longer than sweeps take, and shorter than any scanner's turn. A camera's picture takes longer.
constexpr std::chrono::milliseconds most_held_up{10};

/// Puts those that do not stand still in time behind the others, and returns the first of them.
auto late_of(std::vector<ShardThread*>& halted) {
    const auto time = std::chrono::steady_clock::now() + most_held_up;
    return std::stable_partition(halted.begin(), halted.end(),
                                 [&](ShardThread* thread) { return thread->is_still_by(time); });
}

}  // namespace

Shards::Shards(const boost::asio::any_io_executor& home, World& world, Clock& clock,
               const WallClock& wall_clock, std::size_t count)
    : home_(home), world_(world), home_shard_{0, home, world, clock} {
    if (count < 2) return;
    for (std::size_t number = 0; number < count; ++number)
        threads_.push_back(std::make_unique<ShardThread>(number, wall_clock, home));
    world.on_change(
        [this](const World::Change& change, World::Haste haste) { tell(change, haste); });
}

Shards::~Shards() {
    join();
}

void Shards::on_changed(const std::function<void(std::size_t)>& callback) {
    if (threads_.empty()) return world_.on_placed([callback] { callback(0); });
    for (std::size_t number = 0; number < threads_.size(); ++number)
        threads_[number]->on_changed([callback, number] { callback(number); });
}

void Shards::still_on(std::size_t number, const std::function<void()>& act) {
    if (threads_.empty() || joined_) return act();
    still([&] { threads_[number]->catch_up(act); });
}

void Shards::call_home(std::function<void()> call) {
    if (threads_.empty()) return call();
    boost::asio::post(home_, std::move(call));
}

void Shards::tell(const World::Change& change, World::Haste haste) {
    if (joined_) return;
    kept_.push_back(change);
    if (haste == World::Haste::now) {
        still([this] {
            flush();
            for (const auto& thread : threads_)
                thread->catch_up();
        });
    } else if (kept_.size() == 1) {
        boost::asio::post(home_, [this, alive = std::weak_ptr(alive_)] {
            if (!alive.expired()) flush();
        });
    }
}

void Shards::flush() {
    if (kept_.empty() || joined_) return;
    const auto changes =
        std::make_shared<const std::vector<World::Change>>(std::exchange(kept_, {}));
    for (const auto& thread : threads_)
        thread->tell(changes);
}

// Where some are late, the others go on until these stand still: the scans of one shard do not wait
// for the pictures of another. Who has been late stays as it is, so that this comes to an end.
void Shards::halt() {
    if (halts_++ > 0 || joined_) return;
    flush();
    std::vector<ShardThread*> going;
    for (const auto& thread : threads_)
        going.push_back(thread.get());
    while (!going.empty()) {
        for (ShardThread* thread : going)
            thread->halt();
        const auto late = late_of(going);
        if (late == going.end()) return;
        for (auto thread = going.begin(); thread != late; ++thread)
            (*thread)->go_on();
        for (auto thread = late; thread != going.end(); ++thread)
            (*thread)->wait_until_still([&] { late_((*thread)->shard().number); });
        going.erase(late, going.end());
    }
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
