// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A thread for what takes longer than a driver may wait: it looks at what the thread of the drivers
// has heard, one after the other. That one waits only where too much is left to do.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>
#include <thread>

#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>

#include "tools/scipcat/proxy/heard_queue.h"

namespace scipd::tools {

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
