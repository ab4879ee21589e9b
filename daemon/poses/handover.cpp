// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/poses/handover.h"

#include <utility>

#include <boost/asio/post.hpp>

namespace scipd::daemon {
namespace {

// Some seconds of a busy bus, and a few megabytes.
constexpr std::size_t most_items = 1000;
constexpr std::size_t most_waiting_poses = 20'000;

std::size_t poses_in(const Handover::Item& item) {
    const auto* const heard = std::get_if<Heard>(&item);
    return heard == nullptr ? 0 : heard->poses.size();
}

}  // namespace

void Handover::open(std::function<void()> ready) {
    const std::scoped_lock lock(mutex_);
    ready_ = std::move(ready);
    if (!items_.empty()) announce();
}

void Handover::close() {
    const std::scoped_lock lock(mutex_);
    closed_ = true;
    ready_ = {};
    items_.clear();
    poses_ = 0;
    room_.notify_all();
}

bool Handover::full() const {
    return items_.size() >= most_items || poses_ >= most_waiting_poses;
}

void Handover::drop_first() {
    poses_ -= poses_in(items_.front());
    items_.pop_front();
    ++lost_;
}

void Handover::announce() {
    if (!ready_ || std::exchange(announced_, true)) return;
    boost::asio::post(executor_, ready_);
}

void Handover::put(Item item) {
    std::unique_lock lock(mutex_);
    if (in_lockstep_) room_.wait(lock, [this] { return closed_ || !full(); });
    if (closed_) return;
    while (full())
        drop_first();
    poses_ += poses_in(item);
    items_.push_back(std::move(item));
    announce();
}

std::vector<Handover::Item> Handover::take(std::size_t most_poses) {
    const std::scoped_lock lock(mutex_);
    std::vector<Item> taken;
    std::size_t poses = 0;
    while (!items_.empty() && (taken.empty() || poses + poses_in(items_.front()) <= most_poses)) {
        const std::size_t more = poses_in(items_.front());
        // A message of no pose is work as well.
        poses += more + 1;
        poses_ -= more;
        taken.push_back(std::move(items_.front()));
        items_.pop_front();
    }
    if (taken.empty()) announced_ = false;
    room_.notify_all();
    return taken;
}

std::uint64_t Handover::lost() const {
    const std::scoped_lock lock(mutex_);
    return lost_;
}

}  // namespace scipd::daemon
