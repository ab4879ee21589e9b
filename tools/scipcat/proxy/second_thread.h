// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A thread for what takes longer than a driver may wait: it looks at what the thread of the drivers
// has heard, one after the other. That one waits only where too much is left to do.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>

#include "sim/recording/values/recorded_scan.h"

namespace scipd::tools {

struct Heard {
    enum class What : std::uint8_t { to_scanner, from_scanner, driver_came, driver_left };
    What what = What::from_scanner;
    sim::HostTime time{};
    std::string bytes;
};

/// Takes from one thread to another what it has heard, without a lock: whoever holds one may
/// lose its core, and the other waits for milliseconds. Nor does one of them free what the other
/// has allocated, since the heap has locks as well: the bytes lie in a ring.
class HeardQueue {
  public:
    /// Waits where there is no room, and never for more than that.
    void push(Heard::What what, sim::HostTime time, std::string_view bytes);
    /// Returns nullopt if it is empty.
    [[nodiscard]] std::optional<Heard> pop();

  private:
    struct Head {
        Heard::What what;
        std::uint32_t size;
        std::int64_t time_ns;
    };

    /// At the pace of a UST-10LX, a minute.
    static constexpr std::size_t capacity = std::size_t{1} << 23U;

    void put(std::size_t at, const void* from, std::size_t count);
    void get(std::size_t at, void* to, std::size_t count) const;

    std::unique_ptr<char[]> ring_ = std::make_unique_for_overwrite<char[]>(capacity);
    // Bytes since the beginning.
    std::atomic<std::size_t> pushed_{0};
    std::atomic<std::size_t> popped_{0};
};

class SecondThread {
  public:
    using Look = std::function<void(const Heard& heard)>;

    /// `look` is called there.
    explicit SecondThread(Look look);
    SecondThread(const SecondThread&) = delete;
    SecondThread& operator=(const SecondThread&) = delete;
    ~SecondThread() {
        finish([] {});
    }

    [[nodiscard]] boost::asio::io_context::executor_type executor() { return io_.get_executor(); }
    /// To be looked at there.
    void hand_over(Heard::What what, std::string_view bytes = {});
    /// Returns when all has been looked at, and this was called last. Nothing may follow.
    void finish(const std::function<void()>& last);

  private:
    void run();
    void wait_for_news();
    void look_on();

    Look look_;
    HeardQueue queue_;
    boost::asio::io_context io_{1};
    boost::asio::posix::stream_descriptor news_{io_};  ///< an eventfd: something was handed over
    std::uint64_t count_ = 0;                          ///< that was read from it
    std::thread thread_;
};

}  // namespace scipd::tools
