// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A scanner's tty: a pseudo-terminal behind a symlink that stays the same. To a driver it looks
// like the USB scanner's CDC-ACM device: raw from the start, nothing echoed, any line speed
// accepted; and like that one it goes on existing while nobody has it open, and what is sent then
// is lost. Its last close ends what was begun on it, unless its link has that go on, and leaves
// nothing to the next client. Where its link has a rate it is a serial line instead, on which only
// those understand each other that run at the same one. Lives on the I/O thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>

#include "daemon/device/device.h"
#include "daemon/link/connection.h"

namespace scipd::daemon {

class PtyPort : public std::enable_shared_from_this<PtyPort> {
  public:
    /// Creates the tty and its link, replacing a link that is there but nothing else. Throws
    /// std::runtime_error.
    PtyPort(const boost::asio::any_io_executor& executor, std::filesystem::path link);
    PtyPort(const PtyPort&) = delete;
    PtyPort& operator=(const PtyPort&) = delete;
    /// Takes the link away.
    ~PtyPort();

    /// As TcpPort::serve() and stop(); the latter takes the link away.
    void serve(Device& device, const LinkConfig& link = {});
    void stop();

    [[nodiscard]] const std::filesystem::path& link() const { return link_; }
    [[nodiscard]] bool open() const { return opens_ > 0; }
    [[nodiscard]] std::uint64_t lost_scans() const;

  private:
    void watch();
    /// Reads what has happened to the tty since last time; whether somebody has it open now.
    bool somebody_there();
    void last_one_closed(bool next_was_heard);
    void clean_tty();
    void reopen();
    void watch_for_hang_up();
    void watch_for_clients(const std::string& what);
    void make_link() const;
    void remove_link() const;

    boost::asio::any_io_executor executor_;
    std::filesystem::path link_;
    std::filesystem::path device_path_;  ///< /dev/pts/N
    boost::asio::posix::stream_descriptor master_;
    boost::asio::posix::stream_descriptor
        slave_;  ///< kept open, so that the terminal's settings outlive each driver
    boost::asio::posix::stream_descriptor events_;
    int tty_watch_ = -1;  ///< what its own events are marked with
    std::shared_ptr<Connection> connection_;
    bool stop_on_close_ = true;
    int opens_ = 0;
    std::uint64_t lost_before_ = 0;
};

}  // namespace scipd::daemon
