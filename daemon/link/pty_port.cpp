// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/link/pty_port.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <exception>
#include <system_error>
#include <utility>

#include <boost/asio/post.hpp>
#include <fcntl.h>
#include <stdlib.h>
#include <sys/inotify.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include "daemon/link/line_rate.h"

namespace scipd::daemon {

namespace asio = boost::asio;
using boost::system::error_code;

namespace {

// After a tty that could not come back: not at once again.
constexpr std::chrono::milliseconds again_after{100};

int checked(int result, const std::string& what) {
    if (result < 0) throw std::system_error(errno, std::generic_category(), what);
    return result;
}

/// Closed with `owner`, and at once where that cannot take it.
void give(asio::posix::stream_descriptor& owner, int descriptor, const std::string& what) {
    checked(descriptor, what);
    error_code error;
    owner.assign(descriptor, error);
    if (!error) return;
    ::close(descriptor);
    throw std::system_error(error, what);
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

// As into the control socket: the kernel gives terminals to a group that can only write to them.
// Where scipd cannot give its tty away, it is for this user alone.
void let_group_in(int slave) {
    const bool ours = ::fchown(slave, static_cast<uid_t>(-1), ::getegid()) == 0;
    if (ours) ::fchmod(slave, S_IRUSR | S_IWUSR | S_IRGRP | S_IWGRP);
}

}  // namespace

PtyPort::PtyPort(const asio::any_io_executor& executor, std::filesystem::path link)
    : executor_(executor),
      path_(std::move(link)),
      again_(executor),
      master_(executor),
      slave_(executor),
      events_(executor),
      next_(executor) {
    prepare();
    link_.emplace(path_);
    link_->lead_to(device_path_);
}

PtyPort::~PtyPort() {
    stop();
}

void PtyPort::make_terminal() {
    const std::string no_tty = "cannot make a pseudo-terminal";
    give(master_, ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC), no_tty);
    checked(::grantpt(master_.native_handle()), no_tty);
    checked(::unlockpt(master_.native_handle()), no_tty);
    device_path_ = slave_name(master_.native_handle());
    const std::string what = "cannot use " + device_path_.string();
    give(slave_, ::open(device_path_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC), what);
    checked(make_raw(slave_.native_handle()), what);
    let_group_in(slave_.native_handle());
    // Watched from here on, so this open of our own does not count.
    give(events_, ::inotify_init1(IN_NONBLOCK | IN_CLOEXEC), what);
    watch_for_clients(what);
    ++made_;
    watched_ = false;
}

void PtyPort::close_terminal() {
    error_code ignored;
    for (auto* const descriptor : {&next_, &master_, &events_, &slave_})
        descriptor->close(ignored);
    opens_ = 0;
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

void PtyPort::prepare() {
    if (next_.is_open()) return;
    const bool has_terminal = master_.is_open();
    try {
        if (!has_terminal) make_terminal();
        give(next_, ::fcntl(master_.native_handle(), F_DUPFD_CLOEXEC, 0),
             "cannot use " + device_path_.string());
    } catch (...) {
        if (!has_terminal) close_terminal();
        throw;
    }
}

void PtyPort::serve(Endpoint& scanner, const LinkConfig& link) {
    prepare();
    end_connection();
    scanner_ = &scanner;
    set_line({.link = link});
    connect();
}

void PtyPort::connect() {
    try {
        prepare();
        link_->lead_to(device_path_);
    } catch (const std::exception&) {
        again_.expires_after(again_after);
        return again_.async_wait([self = shared_from_this()](error_code error) {
            if (!error) self->connect_or_hang_up();
        });
    }
    begin(std::make_shared<Connection>(
        std::move(next_), *scanner_, line().link,
        Connection::Hooks{.somebody_there = [this] { return somebody_there(); },
                          .client_rate = [this] { return line_rate(master_.native_handle()); },
                          .kind = protocol::LinkKind::tty}));
    if (std::exchange(watched_, true)) return;
    watch();
    watch_for_hang_up();
}

void PtyPort::stop() {
    scanner_ = nullptr;
    again_.cancel();
    hang_up();
    link_.reset();
}

void PtyPort::cut(Cut /*how*/) {
    if (!connection()) return;
    connection()->abandon();
    asio::post(executor_, [self = shared_from_this(), client = connection()->weak_from_this()] {
        const auto cut_off = client.lock();
        if (!cut_off || cut_off.get() != self->connection()) return;
        self->hang_up();
        self->connect_or_hang_up();
    });
}

void PtyPort::follow_line() {
    asio::post(executor_, [self = shared_from_this()] { self->connect_or_hang_up(); });
}

void PtyPort::connect_or_hang_up() {
    if (!scanner_) return;
    const bool away = line().refuses || line().hung_up;
    if (away && connection()) hang_up();
    if (!away && !connection()) connect();
}

// Whoever has the tty open gets EIO, since the other side of it is closed.
void PtyPort::hang_up() {
    end_connection();
    close_terminal();
    if (link_) link_->remove();
}

void PtyPort::watch() {
    events_.async_wait(asio::posix::stream_descriptor::wait_read,
                       [self = shared_from_this(), made = made_](error_code error) {
                           if (error || made != self->made_) return;
                           self->somebody_there();
                           self->watch();
                       });
}

// Asked before each request is looked at: whatever the one before left behind is gone before the
// new one is answered.
bool PtyPort::somebody_there() {
    alignas(inotify_event) std::array<char, 4096> buffer;
    bool opened = false;
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
            if ((event.mask & IN_OPEN) != 0 && ++opens_ == 1) opened = true;
            if ((event.mask & IN_CLOSE) == 0 || opens_ == 0 || --opens_ > 0) continue;
            closed = true;
            unread = unread || std::exchange(written, false);
        }
    }
    if (closed) last_one_closed(written && !unread);
    if (opened && opens_ > 0) tell_connected();
    return opens_ > 0;
}

// Where both the one before and the next one have written since the tty was looked at, nobody can
// tell whose bytes are whose, and neither is heard: drivers ask again, and none of them gets over
// an answer to another one's request.
void PtyPort::last_one_closed(bool next_was_heard) {
    if (Connection* const client = connection()) {
        line().link.stop_on_close ? client->hang_up() : client->forget();
        if (!next_was_heard) client->drop_input();
    }
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
                      [self = shared_from_this(), made = made_](error_code error) {
                          if (error || made != self->made_) return;
                          self->somebody_there();
                          if (hung_up(self->slave_.native_handle())) self->last_one_closed(true);
                      });
}

}  // namespace scipd::daemon
