// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The way of one sensor from its thread to the I/O thread. Only so much waits at its end: while the
// I/O thread is busy with something else, what comes beyond that is lost and counted. Copies are
// the same lane.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>

namespace scipd::daemon {

class Lane {
  public:
    using Call = std::function<void()>;
    /// Calls it on the I/O thread, from any thread.
    using Way = std::function<void(Call)>;
    /// The bytes that wait in all lanes that share it.
    using Load = std::shared_ptr<std::atomic<std::size_t>>;

    /// So many calls wait in it at most.
    Lane(Way way, std::size_t most, Load load = std::make_shared<std::atomic<std::size_t>>(0))
        : state_(std::make_shared<State>(std::move(way), most, std::move(load))) {}

    /// Whether there is no room, so that nothing need be made that would go by it. Counts a loss.
    [[nodiscard]] bool loses_next();
    /// The call holds so many bytes. To be asked behind loses_next(), on the sensor's thread.
    void post(std::size_t bytes, Call call);
    [[nodiscard]] std::uint64_t lost() const { return state_->lost; }

  private:
    struct State {
        State(Way to, std::size_t calls, Load bytes)
            : way(std::move(to)), most(calls), load(std::move(bytes)) {}

        Way way;
        std::size_t most;
        Load load;
        std::atomic<std::size_t> waiting = 0;
        std::atomic<std::uint64_t> lost = 0;
    };

    std::shared_ptr<State> state_;
};

}  // namespace scipd::daemon
