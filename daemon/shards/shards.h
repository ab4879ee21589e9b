// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// All shards of a simulation, as the I/O thread sees them. It tells them what changes in the world,
// and may touch what lives on them while they stand still. With one shard there is no other thread:
// sensors live on the I/O thread, in the world that is there, and standing still costs nothing. On
// a stepped clock all shards live on the I/O thread, each beside its copy of the world; only calls
// that stand alone (Clock::Beside) are made side by side, and poses that come in bunches are copied
// so. Lives on the I/O thread.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "daemon/clock/stepped_clock.h"
#include "daemon/shards/crew.h"
#include "daemon/shards/shard.h"
#include "daemon/shards/shard_thread.h"
#include "sim/takes_long.h"

namespace scipd::daemon {

class Shards {
  public:
    /// One: sensors live here, in this world. More: as many threads, each with a copy of it, which
    /// must not have begun to change.
    Shards(const boost::asio::any_io_executor& home, World& world, WallClock& clock,
           std::size_t count);
    /// So many shards that live here, on this clock.
    Shards(const boost::asio::any_io_executor& home, World& world, SteppedClock& clock,
           std::size_t count);
    Shards(const Shards&) = delete;
    Shards& operator=(const Shards&) = delete;
    ~Shards();

    [[nodiscard]] std::size_t size() const {
        return std::max({threads_.size(), in_step_.size(), std::size_t{1}});
    }
    [[nodiscard]] Shard& at(std::size_t number);
    /// `callback` is called on a shard's thread after poses have come to its world.
    void on_changed(const std::function<void(std::size_t shard)>& callback);
    /// Called on the I/O thread, which waits, where a shard does not stand still within seconds:
    /// what runs there is stuck, or the machine has no core for it.
    void on_late(std::function<void(std::size_t shard)> callback) { late_ = std::move(callback); }

    /// Calls `act` while every shard stands between two handlers: nothing that takes long may be
    /// done in it (sim/takes_long.h). Changes of the world that were
    /// made before are made in all copies by then; poses that come in it follow behind it.
    template <class Act>
    decltype(auto) still(Act&& act) {
        const Stillness stillness(*this);
        return act();
    }

    /// Calls `act` on the thread of this shard, between two of its handlers, and waits for it; the
    /// others go on. It sees all changes that were made before, within still() as well. For what
    /// casts: a backend that draws is bound to the thread where it is used.
    void still_on(std::size_t number, const std::function<void()>& act);

    /// Calls it on the I/O thread; any thread may ask. From there it is called at once.
    void call_home(std::function<void()> call);

    /// No handler of a shard runs any more.
    void join();

  private:
    /// One that lives on the I/O thread, beside others.
    struct InStep {
        InStep(std::size_t number, const boost::asio::any_io_executor& home, Clock& clock)
            : world(number), shard{number, home, world, clock} {}
        World world;
        Shard shard;
    };

    class Stillness {
      public:
        explicit Stillness(Shards& shards) : shards_(shards) { shards_.halt(); }
        Stillness(const Stillness&) = delete;
        Stillness& operator=(const Stillness&) = delete;
        ~Stillness() { shards_.go_on(); }

      private:
        Shards& shards_;
        sim::MustBeQuick must_be_quick_;
    };

    void tell(const World::Change& change, World::Haste haste);
    void change_in_step(const std::vector<World::Change>& changes);
    void call_side_by_side(const std::vector<SteppedClock::SlowCall>& calls);
    /// Hands over what is kept to be told at once.
    void flush();
    void halt();
    void wait_for(ShardThread& thread);
    void go_on();

    boost::asio::any_io_executor home_;
    World& world_;
    Shard home_shard_;
    std::vector<std::unique_ptr<ShardThread>> threads_;
    std::vector<std::unique_ptr<InStep>> in_step_;
    std::unique_ptr<Crew> crew_;  ///< null: nothing is done side by side
    std::function<void(std::size_t)> changed_ = [](std::size_t) {};  ///< for those in step
    std::function<void(std::size_t)> late_ = [](std::size_t) {};
    std::vector<World::Change> kept_;  ///< poses come in bunches, and waking a thread takes longer
    int halts_ = 0;                    ///< still() may be called within still()
    bool joined_ = false;
    std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);
};

}  // namespace scipd::daemon
