// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/world/worker.h"

#include <utility>

#include <boost/asio/post.hpp>
#include <malloc.h>

namespace scipd::daemon {
namespace {

// Otherwise the C library keeps the memory of a large world, gigabytes of it: the world took it in
// many pieces, and what lies between some of them is still in use.
void give_free_memory_back() {
    malloc_trim(0);
}

}  // namespace

Worker::~Worker() {
    stop();
    thread_.join();
}

void Worker::add(Begin begin, std::stop_token withdrawn) {
    if (*here_ == nullptr) return;
    forget_withdrawn();
    waiting_.push_back({std::move(begin), std::move(withdrawn)});
    if (!busy_) next();
}

void Worker::forget_withdrawn() {
    std::erase_if(waiting_, [](const Waiting& one) { return one.withdrawn.stop_requested(); });
}

void Worker::discard(std::shared_ptr<void> what) {
    boost::asio::post(thread_, [what = std::move(what)]() mutable { what.reset(); });
}

void Worker::stop() {
    *here_ = nullptr;
    waiting_.clear();
    stopping_.request_stop();
}

void Worker::next() {
    forget_withdrawn();
    busy_ = !waiting_.empty();
    if (!busy_) {
        if (frees_) boost::asio::post(thread_, give_free_memory_back);
        return;
    }
    const Begin begin = std::move(waiting_.front().begin);
    waiting_.pop_front();
    boost::asio::post(thread_, [io = io_, here = here_, work = begin()] {
        boost::asio::post(io, [here, finish = work()] {
            if (*here != nullptr) finish();
            // finish() may have stopped or destroyed the worker.
            if (*here != nullptr) (*here)->next();
        });
    });
}

}  // namespace scipd::daemon
