// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A thread for what takes longer than a driver may wait: it does, one after the other, what the
// thread of the drivers hands over. That one waits only where too much is left to do.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <thread>

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>

namespace scipd::tools {

class SecondThread {
  public:
    SecondThread() : thread_([this] { run(); }) {}
    SecondThread(const SecondThread&) = delete;
    SecondThread& operator=(const SecondThread&) = delete;
    ~SecondThread() {
        finish([] {});
    }

    [[nodiscard]] boost::asio::io_context::executor_type executor() { return io_.get_executor(); }
    /// To be done there. `bytes`: what it holds.
    void hand_over(std::size_t bytes, std::function<void()> work);
    /// Returns when all has been done, and this last. Nothing may follow.
    void finish(const std::function<void()>& last);

  private:
    /// At the pace of a UST-10LX, two minutes.
    static constexpr std::size_t most_bytes = std::size_t{16} << 20U;

    void run();

    boost::asio::io_context io_{1};
    boost::asio::executor_work_guard<boost::asio::io_context::executor_type> work_{
        io_.get_executor()};
    std::atomic<std::size_t> bytes_{0};  ///< that are handed over and not done
    std::thread thread_;
};

}  // namespace scipd::tools
