// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/proxy/second_thread.h"

#include <utility>

#include <boost/asio/post.hpp>

namespace scipd::tools {

void SecondThread::hand_over(std::size_t bytes, std::function<void()> work) {
    for (std::size_t left = bytes_; left > most_bytes; left = bytes_)
        bytes_.wait(left);
    bytes_ += bytes;
    boost::asio::post(io_, [this, bytes, work = std::move(work)] {
        work();
        bytes_ -= bytes;
        bytes_.notify_one();
    });
}

void SecondThread::finish(const std::function<void()>& last) {
    if (!thread_.joinable()) return;
    boost::asio::post(io_, [&] {
        last();
        io_.stop();
    });
    thread_.join();
}

}  // namespace scipd::tools
