// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One connection to a scanner, over TCP or a tty, from its begin to its end. It moves bytes and
// decides nothing. What is to be written before it is there waits. One thread.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/steady_timer.hpp>

#include "tools/scip_transport.h"
#include "tools/target.h"

namespace scipd::tools {

class FarEnd : public std::enable_shared_from_this<FarEnd> {
  public:
    struct Hooks {
        std::function<void()> opened;
        std::function<void(std::string_view bytes)> heard;
        /// All that was to be written has been.
        std::function<void()> drained;
        /// Nothing more goes either way, and nothing more is told.
        std::function<void(const std::string& why)> lost;
    };

    FarEnd(const boost::asio::any_io_executor& executor, Hooks hooks);
    FarEnd(const FarEnd&) = delete;
    FarEnd& operator=(const FarEnd&) = delete;
    ~FarEnd() = default;

    /// Begins to connect. No hook is called before this has returned.
    void open(const Target& target, const OpenOptions& options);
    /// No hook is called any more.
    void close();

    void write(std::string_view bytes);
    [[nodiscard]] std::size_t unwritten() const { return writing_.size() + waiting_.size(); }
    /// Sets a tty's rate for what comes next. Over TCP there is none to set. False: the tty cannot
    /// do it.
    [[nodiscard]] bool set_rate(int bits_per_second);
    /// Nothing more will be written: over TCP the scanner is told.
    void end_writing();
    /// Does not read until resume(): the other end has to wait.
    void pause() { paused_ = true; }
    void resume();

  private:
    void open(const TcpTarget& target, const OpenOptions& options);
    void open(const TtyTarget& target, const OpenOptions& options);
    void connect(const boost::asio::ip::tcp::resolver::results_type& places);
    void take(int descriptor);
    void read();
    void write_on();
    void lose(const std::string& why);
    void lose_soon(const std::string& why);

    Hooks hooks_;
    std::string place_;  ///< for people
    boost::asio::ip::tcp::resolver resolver_;
    boost::asio::ip::tcp::socket socket_;  ///< while it connects
    boost::asio::steady_timer patience_;
    boost::asio::posix::stream_descriptor stream_;
    std::array<char, 65536> input_;
    std::string writing_;  ///< the kernel has it next
    std::string waiting_;  ///< comes behind that
    bool closed_ = false;
    bool reading_ = false;
    bool paused_ = false;
    bool ends_writing_ = false;
};

}  // namespace scipd::tools
