// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One shard: a thread that runs the handlers of its sensors, and a copy of the world that only this
// thread touches. Of what is ready, requests and replies come first, then one sweep: so no reply
// waits for more sweeps than the one that is under way. Others tell it what changes in the world,
// and may have it stand still between two handlers. All that is public may be called from the I/O
// thread; nothing else calls it.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>

#include "daemon/clock/wall_clock.h"
#include "daemon/shards/shard.h"

namespace scipd::daemon {

class ShardThread {
  public:
    /// Runs from here on. Exceptions of handlers are thrown again in `home`.
    ShardThread(std::size_t number, const WallClock& clock, boost::asio::any_io_executor home);
    ShardThread(const ShardThread&) = delete;
    ShardThread& operator=(const ShardThread&) = delete;
    /// As join().
    ~ShardThread();

    [[nodiscard]] Shard& shard() { return shard_; }
    /// Called on its thread, after changes. To be set before anything lives here, or while it
    /// stands still.
    void on_changed(std::function<void()> callback) { on_changed_ = std::move(callback); }

    /// Several shards share them.
    using Changes = std::shared_ptr<const std::vector<World::Change>>;
    /// What is told first is done first, before the next handler or a sweep that has given way
    /// before; while it stands still, when it goes on.
    void tell(Changes changes);

    using Time = std::chrono::steady_clock::time_point;

    /// It stands still as soon as the handler that runs now has ended. Between two halts it does
    /// something: a sweep at most.
    void halt();
    /// Waits until it stands still, at most until that time. Returns whether it does.
    bool wait_until_still_by(Time time);
    /// Returns when it stands still, and all that it was told before halt() is done. Calls `late`
    /// where that takes longer than any sweep does.
    void wait_until_still(const std::function<void()>& late);
    /// The shard stands still: it does all that it was told, and then `errand`, on its thread.
    /// Returns when that is done.
    void catch_up(std::function<void()> errand = [] {});
    void go_on();

    /// Runs no handler any more, and has ended when this returns.
    void join();

  private:
    void run();
    /// Takes what it was told, and stands still as long as it is to.
    void answer();
    /// Whether there were any. Unlocks meanwhile.
    bool take_changes(std::unique_lock<std::mutex>& lock);
    template <class Act>
    void guarded(Act act);
    void wake();

    /// Runs what is ready and short, then one call that takes long, unless it is called.
    void run_some();

    boost::asio::any_io_executor home_;
    boost::asio::io_context io_{1};
    boost::asio::executor_work_guard<boost::asio::io_context::executor_type> work_{
        io_.get_executor()};
    std::deque<Clock::Call> slow_;  ///< calls that take long and are due
    bool gave_way_ = false;         ///< run_some() did, the last time
    WallClock clock_;
    World world_;
    Shard shard_;
    std::function<void()> on_changed_ = [] {};

    std::atomic<bool> called_ = false;  ///< there is something below to look at
    std::mutex mutex_;
    std::condition_variable still_changed_;
    std::vector<Changes> changes_;
    bool halted_ = false;
    bool still_ = false;
    bool catches_up_ = false;
    std::function<void()> errand_;  ///< while it catches up
    bool ending_ = false;

    bool ended_ = false;  ///< its own copy of that
    std::thread thread_;  ///< last: it uses all of the above
};

}  // namespace scipd::daemon
