// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/shards/crew.h"

#include <cassert>
#include <string>
#include <utility>

#include <pthread.h>

namespace scipd::daemon {

Crew::Crew(std::size_t hands) {
    for (std::size_t hand = 0; hand < hands; ++hand) {
        threads_.emplace_back([this, hand] { run(hand); });
        ::pthread_setname_np(threads_.back().native_handle(),
                             ("casts " + std::to_string(hand + 1)).c_str());
    }
}

Crew::~Crew() {
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
    }
    begun_.notify_all();
    for (std::thread& thread : threads_)
        thread.join();
}

void Crew::work(std::span<const Job> jobs) {
    assert(jobs.size() <= threads_.size() + 1);
    if (jobs.empty()) return;
    {
        const std::lock_guard lock(mutex_);
        jobs_ = jobs;
        at_work_ = threads_.size();
        ++round_;
    }
    begun_.notify_all();
    attempt(jobs.front());
    std::unique_lock lock(mutex_);
    done_.wait(lock, [this] { return at_work_ == 0; });
    if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
}

void Crew::run(std::size_t hand) {
    std::size_t round = 0;
    std::unique_lock lock(mutex_);
    while (true) {
        begun_.wait(lock, [&] { return ending_ || round_ != round; });
        if (ending_) return;
        round = round_;
        if (hand + 1 < jobs_.size()) {
            const Job& job = jobs_[hand + 1];
            lock.unlock();
            attempt(job);
            lock.lock();
        }
        if (--at_work_ == 0) done_.notify_one();
    }
}

void Crew::attempt(const Job& job) {
    try {
        job();
    } catch (...) {
        const std::lock_guard lock(mutex_);
        thrown_ = std::current_exception();
    }
}

}  // namespace scipd::daemon
