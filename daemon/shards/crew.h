// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Threads that do what one thread gives them, side by side with it, while it waits: what they touch
// is as good as its own. Used by one thread.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

namespace scipd::daemon {

class Crew {
  public:
    using Job = std::function<void()>;

    /// So many threads, beside the one that calls.
    explicit Crew(std::size_t hands);
    Crew(const Crew&) = delete;
    Crew& operator=(const Crew&) = delete;
    ~Crew();

    /// Does all jobs, of which there is at most one more than threads, and returns when the last is
    /// done. Throws what one of them has thrown.
    void work(std::span<const Job> jobs);

  private:
    void run(std::size_t hand);
    void attempt(const Job& job);

    std::mutex mutex_;
    std::condition_variable begun_;
    std::condition_variable done_;
    std::span<const Job> jobs_;             ///< job i + 1 is that of hand i
    std::atomic<std::size_t> round_ = 0;    ///< grows with each work()
    std::atomic<std::size_t> at_work_ = 0;  ///< hands that have not ended this round
    std::exception_ptr thrown_;
    std::atomic<bool> ending_ = false;
    std::vector<std::thread> threads_;  ///< last: they use all of the above
};

}  // namespace scipd::daemon
