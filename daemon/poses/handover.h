// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where what a bus says goes over to the I/O thread. A bus never waits for that thread on the wall
// clock: what is too much is lost, the oldest first. In lockstep, where time waits for poses, the
// bus waits. The bus calls what BusListener has; the rest is for the I/O thread.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <variant>
#include <vector>

#include <boost/asio/any_io_executor.hpp>

#include "daemon/bridges/bus.h"

namespace scipd::daemon {

class Handover : public BusListener {
  public:
    struct Refusal {
        std::string why;
    };
    struct Trouble {
        std::string what;  ///< empty: it is over
    };
    using Item = std::variant<Heard, Refusal, Trouble>;

    /// `in_lockstep`: nothing is lost.
    Handover(boost::asio::any_io_executor executor, bool in_lockstep)
        : executor_(std::move(executor)), in_lockstep_(in_lockstep) {}

    /// From now on `ready` is called on the executor where items have come. After that nothing is
    /// called until take() had nothing more to give.
    void open(std::function<void()> ready);
    /// No more items are taken in, and the bus waits no longer.
    void close();

    /// The next items, of so many poses, or one that has more. None: ready() will be called.
    [[nodiscard]] std::vector<Item> take(std::size_t most_poses);
    /// Messages that were too much.
    [[nodiscard]] std::uint64_t lost() const;

    void hear(Heard message) override { put(std::move(message)); }
    void refuse(std::string why) override { put(Refusal{std::move(why)}); }
    void tell_trouble(std::string trouble) override { put(Trouble{std::move(trouble)}); }

  private:
    void put(Item item);
    [[nodiscard]] bool full() const;
    void drop_first();
    void announce();

    boost::asio::any_io_executor executor_;
    const bool in_lockstep_;
    mutable std::mutex mutex_;
    // Protected by the mutex:
    std::condition_variable room_;
    std::deque<Item> items_;
    std::size_t poses_ = 0;  ///< of all items
    std::uint64_t lost_ = 0;
    bool closed_ = false;
    bool announced_ = false;
    std::function<void()> ready_;
};

}  // namespace scipd::daemon
