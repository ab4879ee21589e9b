// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/proxy/second_thread.h"

#include <algorithm>
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

void HeardQueue::push(Heard::What what, sim::HostTime time, std::string_view bytes) {
    constexpr std::size_t most = capacity / 2;
    for (; bytes.size() > most; bytes.remove_prefix(most))
        push(what, time, bytes.substr(0, most));
    const Head head{what, static_cast<std::uint32_t>(bytes.size()),
                    time.time_since_epoch().count()};
    const std::size_t begin = pushed_;
    const std::size_t end = begin + sizeof head + bytes.size();
    for (std::size_t popped = popped_; end - popped > capacity; popped = popped_)
        popped_.wait(popped);
    put(begin, &head, sizeof head);
    put(begin + sizeof head, bytes.data(), bytes.size());
    pushed_ = end;
}

std::optional<Heard> HeardQueue::pop() {
    const std::size_t begin = popped_;
    if (begin == pushed_) return std::nullopt;
    Head head{};
    get(begin, &head, sizeof head);
    Heard heard{head.what, sim::HostTime(sim::HostTime::duration(head.time_ns)),
                std::string(head.size, '\0')};
    get(begin + sizeof head, heard.bytes.data(), head.size);
    popped_ = begin + sizeof head + head.size;
    popped_.notify_one();
    return heard;
}

// Bytes that do not fit before the end of the ring continue at its beginning. memcpy() must not get
// the null pointer of an empty range.
void HeardQueue::put(std::size_t at, const void* from, std::size_t count) {
    const auto* bytes = static_cast<const char*>(from);
    const std::size_t place = at % capacity;
    const std::size_t first = std::min(count, capacity - place);
    std::copy_n(bytes, first, ring_.get() + place);
    std::copy_n(bytes + first, count - first, ring_.get());
}

void HeardQueue::get(std::size_t at, void* to, std::size_t count) const {
    auto* bytes = static_cast<char*>(to);
    const std::size_t place = at % capacity;
    const std::size_t first = std::min(count, capacity - place);
    std::copy_n(ring_.get() + place, first, bytes);
    std::copy_n(ring_.get(), count - first, bytes + first);
}

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
