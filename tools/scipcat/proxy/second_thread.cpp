// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/proxy/second_thread.h"

#include <utility>

#include <boost/asio/post.hpp>
#include <sys/resource.h>
#include <unistd.h>

namespace scipd::tools {

// Where both want a core, a byte on its way comes first: in Linux each thread has a priority of its
// own (setpriority(2)).
void SecondThread::run() {
    constexpr int lower = 10;
    ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), lower);
    io_.run();
}

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
