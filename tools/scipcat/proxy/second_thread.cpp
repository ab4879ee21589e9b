// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/proxy/second_thread.h"

#include <cerrno>
#include <chrono>
#include <system_error>
#include <utility>

#include <boost/asio/buffer.hpp>
#include <boost/asio/post.hpp>
#include <sys/eventfd.h>
#include <sys/resource.h>
#include <unistd.h>

namespace scipd::tools {

SecondThread::SecondThread(Look look) : look_(std::move(look)) {
    const int descriptor = ::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    if (descriptor < 0) throw std::system_error(errno, std::generic_category(), "eventfd");
    news_.assign(descriptor);
    wait_for_news();
    thread_ = std::thread([this] { run(); });
}

// Where both want a core, a byte on its way comes first: in Linux each thread has a priority of its
// own (setpriority(2)).
void SecondThread::run() {
    constexpr int lower = 10;
    ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), lower);
    io_.run();
}

void SecondThread::wait_for_news() {
    news_.async_read_some(boost::asio::buffer(&count_, sizeof count_),
                          [this](const boost::system::error_code& error, std::size_t) {
                              if (!error) look_on();
                          });
}

// The twin answers meanwhile, and is heard in between.
void SecondThread::look_on() {
    const auto heard = queue_.pop();
    if (!heard) return wait_for_news();
    look_(*heard);
    boost::asio::post(io_, [this] { look_on(); });
}

// By a descriptor: to post would take a lock, which that thread may hold when it loses its core.
void SecondThread::hand_over(Heard::What what, std::string_view bytes) {
    queue_.push(what, std::chrono::system_clock::now(), bytes);
    constexpr std::uint64_t one = 1;
    (void)!::write(news_.native_handle(), &one, sizeof one);
}

void SecondThread::finish(const std::function<void()>& last) {
    if (!thread_.joinable()) return;
    boost::asio::post(io_, [&] {
        while (const auto heard = queue_.pop())
            look_(*heard);
        last();
        io_.stop();
    });
    thread_.join();
}

}  // namespace scipd::tools
