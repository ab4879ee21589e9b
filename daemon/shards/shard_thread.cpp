// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/shards/shard_thread.h"

#include <chrono>
#include <exception>
#include <string>
#include <utility>

#include <boost/asio/post.hpp>
#include <pthread.h>

namespace scipd::daemon {

using namespace std::chrono_literals;

ShardThread::ShardThread(std::size_t number, const WallClock& clock,
                         boost::asio::any_io_executor home)
    : home_(std::move(home)),
      clock_(clock, io_.get_executor(),
             [this](Clock::Call call) { slow_.push_back(std::move(call)); }),
      world_(number),
      shard_{number, io_.get_executor(), world_, clock_},
      thread_([this] { run(); }) {
    ::pthread_setname_np(thread_.native_handle(), ("scans " + std::to_string(number)).c_str());
}

ShardThread::~ShardThread() {
    join();
}

void ShardThread::tell(Changes changes) {
    const std::lock_guard lock(mutex_);
    changes_.push_back(std::move(changes));
    wake();
}

void ShardThread::halt() {
    const std::lock_guard lock(mutex_);
    halted_ = true;
    wake();
}

bool ShardThread::wait_until_still_by(Time time) {
    std::unique_lock lock(mutex_);
    return still_changed_.wait_until(lock, time, [this] { return still_; });
}

void ShardThread::wait_until_still(const std::function<void()>& late) {
    if (wait_until_still_by(std::chrono::steady_clock::now() + 2s)) return;
    late();
    std::unique_lock lock(mutex_);
    still_changed_.wait(lock, [this] { return still_; });
}

void ShardThread::catch_up(std::function<void()> errand) {
    std::unique_lock lock(mutex_);
    errand_ = std::move(errand);
    catches_up_ = true;
    still_changed_.notify_all();
    still_changed_.wait(lock, [this] { return !catches_up_; });
}

void ShardThread::go_on() {
    const std::lock_guard lock(mutex_);
    halted_ = false;
    still_ = false;  // whoever halts it at once has to wait for it again
    still_changed_.notify_all();
}

void ShardThread::join() {
    if (!thread_.joinable()) return;
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
        wake();
    }
    thread_.join();
}

// One wake-up does for all that was told since the last look.
void ShardThread::wake() {
    if (!called_.exchange(true)) boost::asio::post(io_, [] {});
}

void ShardThread::run() {
    while (!ended_) {
        guarded([this] {
            if (called_.exchange(false)) answer();
            if (!ended_) run_some();
        });
    }
    // A context of EGL that is current in a thread that ends is never freed.
    guarded([this] { (void)world_.replace_backends({}); });
}

void ShardThread::run_some() {
    if (slow_.empty()) io_.run_one();
    // Who calls is answered first, but not twice: one who calls again and again holds up nobody.
    const bool gives_way = !gave_way_;
    // A client may never stop asking: not all of that is heard first.
    constexpr int most_at_once = 64;
    for (int i = 0; i < most_at_once && !(called_ && gives_way); ++i) {
        if (io_.poll_one() == 0) break;
    }
    gave_way_ = called_ && gives_way;
    if (gave_way_ || slow_.empty()) return;
    const Clock::Call call = std::move(slow_.front());
    slow_.pop_front();
    call();
}

void ShardThread::answer() {
    bool changed = false;
    {
        std::unique_lock lock(mutex_);
        changed |= take_changes(lock);
        bool let_go = !halted_;
        while (!let_go) {
            if (catches_up_) guarded(std::exchange(errand_, {}));
            still_ = true;
            catches_up_ = false;
            still_changed_.notify_all();
            still_changed_.wait(lock, [this] { return !still_ || catches_up_; });
            // It may be halted again by now, and does something in between.
            let_go = !still_;
            changed |= take_changes(lock);
        }
        ended_ = ending_;
    }
    if (changed && !ended_) on_changed_();
}

bool ShardThread::take_changes(std::unique_lock<std::mutex>& lock) {
    bool any = false;
    while (!changes_.empty()) {
        any = true;
        const auto told = std::exchange(changes_, {});
        lock.unlock();
        for (const Changes& changes : told) {
            for (const World::Change& change : *changes)
                guarded([&] { change(world_); });
        }
        lock.lock();
    }
    return any;
}

template <class Act>
void ShardThread::guarded(Act act) {
    try {
        act();
    } catch (...) {
        boost::asio::post(home_,
                          [thrown = std::current_exception()] { std::rethrow_exception(thrown); });
    }
}

}  // namespace scipd::daemon
