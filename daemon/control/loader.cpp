// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/control/loader.h"

#include <utility>

#include <boost/asio/post.hpp>

namespace scipd::daemon {

Loader::~Loader() {
    stop();
    thread_.join();
}

void Loader::add(Begin begin) {
    if (*here_ == nullptr) return;
    waiting_.push_back(std::move(begin));
    if (!busy_) next();
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
    busy_ = !waiting_.empty();
    if (!busy_) return;
    const Begin begin = std::move(waiting_.front());
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
