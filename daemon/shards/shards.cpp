// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/shards/shards.h"

#include <utility>

#include <boost/asio/post.hpp>

namespace scipd::daemon {

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

void Shards::call_home(std::function<void()> call) {
    if (threads_.empty()) return call();
    boost::asio::post(home_, std::move(call));
}

void Shards::tell(const World::Change& change, World::Haste haste) {
    if (joined_) return;
    if (haste == World::Haste::now && halts_ == 0)
        return still([&] { tell(change, World::Haste::soon); });
    for (const auto& thread : threads_)
        thread->tell(change);
    if (halts_ == 0) return;
    for (const auto& thread : threads_)
        thread->wait_until_still();
}

void Shards::halt() {
    if (halts_++ > 0 || joined_) return;
    for (const auto& thread : threads_)
        thread->halt();
    for (const auto& thread : threads_)
        thread->wait_until_still();
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
