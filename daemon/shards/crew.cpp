// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/shards/crew.h"

#include <cassert>
#include <chrono>
#include <string>
#include <utility>

#include <pthread.h>

namespace scipd::daemon {
namespace {

/// Between two rounds of lockstep lies less than half of this, and waking up takes a tenth of it.
constexpr std::chrono::milliseconds soon{1};

/// Stays awake, but lets others go first, until it is so or has not come soon.
template <class Condition>
void watch_for(const Condition& so) {
    const auto until = std::chrono::steady_clock::now() + soon;
    while (!so() && std::chrono::steady_clock::now() < until)
        std::this_thread::yield();
}

}  // namespace

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
    if (jobs.size() == 1) return jobs.front()();
    if (jobs.empty()) return;
    {
        const std::lock_guard lock(mutex_);
        jobs_ = jobs;
        at_work_ = threads_.size();
        ++round_;
    }
    begun_.notify_all();
    attempt(jobs.front());
    watch_for([this] { return at_work_ == 0; });
    std::unique_lock lock(mutex_);
    done_.wait(lock, [this] { return at_work_ == 0; });
    if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
}

void Crew::run(std::size_t hand) {
    std::size_t round = 0;
    std::unique_lock lock(mutex_);
    while (true) {
        const auto called = [&] { return ending_ || round_ != round; };
        lock.unlock();
        watch_for(called);
        lock.lock();
        begun_.wait(lock, called);
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
