// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A scanner's tty: a pseudo-terminal behind a symlink that stays the same. To a driver it looks
// like the USB scanner's CDC-ACM device: it is raw from the start, echoes nothing and accepts any
// line speed. Like that one it goes on existing while nobody has it open, and what is sent then is
// lost. Its last close ends what was begun on it, unless the link is configured to let that go on,
// and leaves nothing to the next client. Another scanner behind it is another device: the tty hangs
// up, and a new one comes under its name. Where the link has a rate the tty is a serial line
// instead: two ends understand each other only at the same rate. Lives on its shard.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/steady_timer.hpp>

#include "daemon/link/port.h"
#include "daemon/link/tty_link.h"
#include "daemon/link/tty_opens.h"

namespace scipd::daemon {

class PtyPort : public Port, public std::enable_shared_from_this<PtyPort> {
  public:
    /// Creates the tty and its link, in place of one that a scipd left behind that was killed, but
    /// of nothing else. Throws PathHeld where somebody uses the link, else std::runtime_error.
    PtyPort(const boost::asio::any_io_executor& executor, std::filesystem::path link);
    PtyPort(const PtyPort&) = delete;
    PtyPort& operator=(const PtyPort&) = delete;
    /// As stop().
    ~PtyPort() override;

    void prepare() override;
    void serve(Endpoint& scanner, const LinkConfig& link = {}) override;
    /// Takes the link away as well.
    void stop() override;

    [[nodiscard]] std::string address() const override { return path_; }
    /// Whether a driver has the tty open.
    [[nodiscard]] bool connected() const override { return opens_.any(); }
    [[nodiscard]] protocol::LinkKind kind() const override { return protocol::LinkKind::tty; }
    void cut(Cut how) override;

  private:
    /// A pseudo-terminal. Closed: there is none.
    struct Terminal {
        explicit Terminal(const boost::asio::any_io_executor& executor)
            : master(executor), slave(executor), next(executor) {}
        /// Creates one. Throws std::system_error.
        void make();
        void close();

        std::filesystem::path path;  ///< /dev/pts/N
        boost::asio::posix::stream_descriptor master;
        /// Kept open, so that the terminal's settings outlive each driver.
        boost::asio::posix::stream_descriptor slave;
        Connection::Descriptor next;  ///< of the connection to come; closed: that has come
    };

    /// In place of the present terminal, which hangs up. Throws std::system_error.
    void change_terminal();
    void follow_line() override;
    void connect_or_hang_up();
    /// Tries until there is a tty under its name, or is to be none any more.
    void connect();
    void connect_later(const std::string& why);
    void hang_up();
    void watch();
    /// Reads what has happened to the tty since last time. Answers whether somebody has it open
    /// now.
    bool somebody_there();
    [[nodiscard]] bool somebody_else();
    /// `waits`: there is some that has not been read.
    void drop_input(bool waits);
    void last_one_closed();
    void clean_tty();
    /// In place of the open of the terminal that it has kept so far. False: that is none.
    [[nodiscard]] bool hold_open(int slave);
    void watch_for_hang_up();

    boost::asio::any_io_executor executor_;
    std::filesystem::path path_;
    std::optional<TtyLink> link_;
    Endpoint* scanner_ = nullptr;  ///< null: stopped, or not served yet
    boost::asio::steady_timer again_;
    int made_ = 0;          ///< counts its pseudo-terminals
    bool watched_ = false;  ///< the present one
    Terminal now_;
    Terminal prepared_;  ///< for the next scanner
    TtyOpens opens_;
    std::string missing_;  ///< why there is no tty under its name, as was told last
};

}  // namespace scipd::daemon
