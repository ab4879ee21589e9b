// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/link/pty_port.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <stdlib.h>
#include <sys/inotify.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include "daemon/link/line_rate.h"

namespace scipd::daemon {

namespace asio = boost::asio;
using boost::system::error_code;

namespace {

int checked(int result, const std::string& what) {
    if (result < 0) throw std::system_error(errno, std::generic_category(), what);
    return result;
}

int open_master() {
    const int master =
        checked(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC), "cannot make a pseudo-terminal");
    checked(::grantpt(master), "cannot make a pseudo-terminal");
    checked(::unlockpt(master), "cannot make a pseudo-terminal");
    return master;
}

std::string slave_name(int master) {
    std::array<char, 64> name{};
    checked(-::ptsname_r(master, name.data(), name.size()), "cannot name the pseudo-terminal");
    return name.data();
}

bool hung_up(int slave) {
    termios settings{};
    return ::tcgetattr(slave, &settings) < 0 && errno == EIO;
}

int make_raw(int slave) {
    termios settings{};
    if (::tcgetattr(slave, &settings) < 0) return -1;
    ::cfmakeraw(&settings);
    return ::tcsetattr(slave, TCSANOW, &settings);
}

}  // namespace

PtyPort::PtyPort(const asio::any_io_executor& executor, std::filesystem::path link)
    : executor_(executor),
      link_(std::move(link)),
      master_(executor, open_master()),
      slave_(executor),
      events_(executor) {
    device_path_ = slave_name(master_.native_handle());
    const std::string what = "cannot use " + device_path_.string();
    slave_.assign(checked(::open(device_path_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC), what));
    checked(make_raw(slave_.native_handle()), what);
    // Watched from here on, so this open of our own does not count.
    events_.assign(checked(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC), what));
    watch_for_clients(what);
    make_link();
}

PtyPort::~PtyPort() {
    remove_link();
}

// The kernel merges an event with an equal one right before it: of two drivers that open the tty
// while this thread is busy one would be missed. So each of them is told twice, by the folder and
// by the tty, and none is like the one before it. Writes are told by the tty alone: others write to
// other terminals.
void PtyPort::watch_for_clients(const std::string& what) {
    const auto watch = [&](const std::filesystem::path& path, std::uint32_t events) {
        return checked(::inotify_add_watch(events_.native_handle(), path.c_str(), events), what);
    };
    tty_watch_ = watch(device_path_, IN_OPEN | IN_CLOSE | IN_MODIFY);
    watch(device_path_.parent_path(), IN_OPEN | IN_CLOSE);
}

void PtyPort::serve(Device& device, const LinkConfig& link) {
    if (connection_) {
        lost_before_ += connection_->lost();
        connection_->close();
    }
    const int descriptor = checked(::fcntl(master_.native_handle(), F_DUPFD_CLOEXEC, 0),
                                   "cannot use the pseudo-terminal");
    stop_on_close_ = link.stop_on_close;
    const bool watched = connection_ != nullptr;
    connection_ = std::make_shared<Connection>(
        Connection::Descriptor(executor_, descriptor), device, link,
        Connection::Hooks{.somebody_there = [this] { return somebody_there(); },
                          .client_rate = [this] { return line_rate(master_.native_handle()); },
                          .survives_boot = true});
    connection_->start();
    if (watched) return;
    watch();
    watch_for_hang_up();
}

void PtyPort::stop() {
    if (connection_) connection_->close();
    error_code ignored;
    events_.close(ignored);
    slave_.close(ignored);
    remove_link();
}

std::uint64_t PtyPort::lost_scans() const {
    return lost_before_ + (connection_ ? connection_->lost() : 0);
}

void PtyPort::watch() {
    events_.async_wait(asio::posix::stream_descriptor::wait_read,
                       [self = shared_from_this()](error_code error) {
                           if (error) return;
                           self->somebody_there();
                           self->watch();
                       });
}

// Asked before each request is looked at: whatever the one before left behind is gone before the
// new one is answered.
bool PtyPort::somebody_there() {
    alignas(inotify_event) std::array<char, 4096> buffer;
    bool closed = false;
    bool written = false;  // by whoever has it open
    bool unread = false;   // by whoever has closed it
    for (;;) {
        const ssize_t count = ::read(events_.native_handle(), buffer.data(), buffer.size());
        if (count <= 0) break;
        for (ssize_t at = 0; at < count;) {
            inotify_event event;
            std::memcpy(&event, buffer.data() + at, sizeof(event));
            at += static_cast<ssize_t>(sizeof(event) + event.len);
            if (event.wd != tty_watch_) continue;
            if ((event.mask & IN_MODIFY) != 0) written = true;
            if ((event.mask & IN_OPEN) != 0) ++opens_;
            if ((event.mask & IN_CLOSE) == 0 || opens_ == 0 || --opens_ > 0) continue;
            closed = true;
            unread = unread || std::exchange(written, false);
        }
    }
    if (closed) last_one_closed(written && !unread);
    return opens_ > 0;
}

// Where both the one before and the next one have written since the tty was looked at, nobody can
// tell whose bytes are whose, and neither is heard: drivers ask again, and none of them gets over
// an answer to another one's request.
void PtyPort::last_one_closed(bool next_was_heard) {
    if (connection_ && stop_on_close_) {
        connection_->hang_up();
    } else if (connection_) {
        connection_->forget();
    }
    if (connection_ && !next_was_heard) connection_->drop_input();
    if (!next_was_heard) ::tcflush(master_.native_handle(), TCIFLUSH);
    clean_tty();
}

// A tty forgets its settings with its last close; this one is still open here, so that it is for us
// to undo what a driver did.
void PtyPort::clean_tty() {
    if (hung_up(slave_.native_handle())) reopen();
    const int slave = slave_.native_handle();
    ::tcflush(slave, TCIFLUSH);
    ::tcflow(slave, TCOON);
    ::ioctl(slave, TIOCNXCL);
    make_raw(slave);
}

// A hang-up (vhangup) cuts off whoever has the tty open, which we are as well, and takes the
// settings back. Opened before it is closed: without anybody the tty would end. Where it cannot be
// opened the next close tries again.
void PtyPort::reopen() {
    const int fresh = ::open(device_path_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (fresh < 0) return;
    error_code error;
    slave_.close(error);
    slave_.assign(fresh, error);
    if (error) {
        ::close(fresh);
        return;
    }
    watch_for_hang_up();
}

// Those that were cut off may keep their descriptors for long.
void PtyPort::watch_for_hang_up() {
    slave_.async_wait(asio::posix::stream_descriptor::wait_error,
                      [self = shared_from_this()](error_code error) {
                          if (error) return;
                          self->somebody_there();
                          if (hung_up(self->slave_.native_handle())) self->last_one_closed(true);
                      });
}

void PtyPort::make_link() const {
    namespace fs = std::filesystem;
    const std::string other_name = "; choose another name for the tty";
    if (fs::exists(fs::symlink_status(link_)) && !fs::is_symlink(link_)) {
        throw std::runtime_error(link_.string() + " is there and is no link" + other_name);
    }
    try {
        if (link_.has_parent_path()) fs::create_directories(link_.parent_path());
        const fs::path fresh = link_.string() + ".new";
        fs::remove(fresh);
        fs::create_symlink(device_path_, fresh);
        fs::rename(fresh, link_);
    } catch (const fs::filesystem_error& error) {
        throw std::runtime_error("cannot make the link " + link_.string() + ": " +
                                 error.code().message() + other_name);
    }
}

void PtyPort::remove_link() const {
    std::error_code none;
    if (std::filesystem::read_symlink(link_, none) == device_path_)
        std::filesystem::remove(link_, none);
}

}  // namespace scipd::daemon
