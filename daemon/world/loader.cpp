// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/world/loader.h"

#include <utility>

#include <boost/asio/post.hpp>
#include <malloc.h>

namespace scipd::daemon {
namespace {

// What a large world was spread over stays with the C library otherwise, gigabytes of it, since it
// came in pieces and some between them are in use.
void give_free_memory_back() {
    malloc_trim(0);
}

}  // namespace

Loader::~Loader() {
    stop();
    thread_.join();
}

void Loader::add(Begin begin, std::stop_token withdrawn) {
    if (*here_ == nullptr) return;
    forget_withdrawn();
    waiting_.push_back({std::move(begin), std::move(withdrawn)});
    if (!busy_) next();
}

void Loader::forget_withdrawn() {
    std::erase_if(waiting_, [](const Waiting& one) { return one.withdrawn.stop_requested(); });
}

void Loader::discard(std::shared_ptr<void> what) {
    boost::asio::post(thread_, [what = std::move(what)]() mutable { what.reset(); });
}

void Loader::stop() {
    *here_ = nullptr;
    waiting_.clear();
    stopping_.request_stop();
}

void Loader::next() {
    forget_withdrawn();
    busy_ = !waiting_.empty();
    if (!busy_) return boost::asio::post(thread_, give_free_memory_back);
    const Begin begin = std::move(waiting_.front().begin);
    waiting_.pop_front();
    boost::asio::post(thread_, [io = io_, here = here_, work = begin()] {
        boost::asio::post(io, [here, finish = work()] {
            if (*here != nullptr) finish();
            // Which may have been the end.
            if (*here != nullptr) (*here)->next();
        });
    });
}

}  // namespace scipd::daemon
