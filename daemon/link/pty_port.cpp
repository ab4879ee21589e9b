// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/link/pty_port.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <exception>
#include <system_error>
#include <utility>

#include <boost/asio/post.hpp>
#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <sys/poll.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include "daemon/link/descriptors.h"
#include "daemon/link/line_rate.h"

namespace scipd::daemon {

namespace asio = boost::asio;
using boost::system::error_code;

namespace {

// After a tty that could not come back: not at once again.
constexpr std::chrono::milliseconds again_after{100};

std::string slave_name(int master) {
    std::array<char, 64> name{};
    checked(-::ptsname_r(master, name.data(), name.size()), "cannot name the pseudo-terminal");
    return name.data();
}

int open_slave(const std::filesystem::path& path) {
    return ::open(path.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
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
      now_(executor),
      prepared_(executor),
      opens_(executor) {
    prepare();
    change_terminal();
    link_.emplace(path_);
    link_->lead_to(now_.path);
}

PtyPort::~PtyPort() {
    stop();
}

void PtyPort::Terminal::make() {
    const std::string no_tty = "cannot make a pseudo-terminal";
    give(master, ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC), no_tty);
    checked(::grantpt(master.native_handle()), no_tty);
    checked(::unlockpt(master.native_handle()), no_tty);
    path = slave_name(master.native_handle());
    const std::string what = "cannot use " + path.string();
    give(slave, open_slave(path), what);
    checked(make_raw(slave.native_handle()), what);
    let_group_in(slave.native_handle());
    give(next, ::fcntl(master.native_handle(), F_DUPFD_CLOEXEC, 0), what);
}

void PtyPort::Terminal::close() {
    error_code ignored;
    for (auto* const descriptor : {&next, &master, &slave})
        descriptor->close(ignored);
}

void PtyPort::prepare() {
    if (now_.next.is_open() || prepared_.next.is_open()) return;
    Terminal made(executor_);
    made.make();
    prepared_ = std::move(made);
}

// Watched from here on, so the open of our own does not count.
void PtyPort::change_terminal() {
    opens_.begin(prepared_.path);
    if (link_) link_->remove();
    now_ = std::exchange(prepared_, Terminal(executor_));
    ++made_;
    watched_ = false;
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
        if (!connection()) prepare();
        if (!connection() && prepared_.next.is_open()) change_terminal();
        link_->lead_to(now_.path);
    } catch (const std::exception& error) {
        return connect_later(error.what());
    }
    if (!std::exchange(missing_, {}).empty()) spdlog::info("the tty {} is back", path_.string());
    if (connection()) return;
    begin(std::make_shared<Connection>(
        std::move(now_.next), *scanner_, line().link,
        Connection::Hooks{.somebody_there = [this] { return somebody_there(); },
                          .client_rate = [this] { return line_rate(now_.master.native_handle()); },
                          .kind = protocol::LinkKind::tty}));
    if (std::exchange(watched_, true)) return;
    watch();
    watch_for_hang_up();
}

void PtyPort::connect_later(const std::string& why) {
    if (std::exchange(missing_, why) != why)
        spdlog::warn("the tty {} is not there, and comes when it can: {}", path_.string(), why);
    again_.expires_after(again_after);
    again_.async_wait([self = shared_from_this()](error_code error) {
        if (!error) self->connect_or_hang_up();
    });
}

void PtyPort::stop() {
    scanner_ = nullptr;
    again_.cancel();
    hang_up();
    prepared_.close();
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

// Who has the tty open stays where nobody else can find it.
void PtyPort::connect_or_hang_up() {
    if (!scanner_) return;
    if (line().hung_up) {
        if (connection()) hang_up();
    } else if (line().refuses) {
        link_->remove();
    } else {
        connect();
    }
}

// Whoever has the tty open gets EIO, since the other side of it is closed.
void PtyPort::hang_up() {
    end_connection(scanner_ ? Leaving::cut : Leaving::ended);
    now_.close();
    opens_.end();
    if (link_) link_->remove();
}

void PtyPort::watch() {
    opens_.async_wait([self = shared_from_this(), made = made_](error_code error) {
        if (error || made != self->made_) return;
        self->somebody_there();
        self->watch();
    });
}

// Asked before each request is looked at: whatever the one before left behind is gone before the
// new one is answered.
bool PtyPort::somebody_there() {
    int waiting = 0;
    const auto unread = [&] {
        // What was written may still be on its way through the kernel, where FIONREAD does not see
        // it. poll() waits for it (tty_buffer_flush_work() in Linux's n_tty_poll()).
        pollfd input{.fd = now_.master.native_handle(), .events = POLLIN, .revents = 0};
        ::poll(&input, 1, 0);
        ::ioctl(now_.master.native_handle(), FIONREAD, &waiting);
        return waiting > 0 || (connection() && connection()->has_input());
    };
    const TtyOpens::News news = opens_.look([this] { return somebody_else(); }, unread);
    // At once: the next one may write right now, and a line of the log takes a while.
    if (news.closed && !news.next_was_heard) drop_input(waiting > 0 || news.last_has_written);
    if (news.closed) tell_left(Leaving::closed);
    if (news.closed) last_one_closed();
    if (news.opened) tell_connected({});
    return opens_.any();
}

// Once nobody has the tty open its other side hangs up, so we let go of it for a moment. A driver
// may have taken it for itself (TIOCEXCL), which would keep us out.
bool PtyPort::somebody_else() {
    int exclusive = 0;
    ::ioctl(now_.slave.native_handle(), TIOCGEXCL, &exclusive);
    ::ioctl(now_.slave.native_handle(), TIOCNXCL);
    error_code ignored;
    now_.slave.close(ignored);
    pollfd other_side{.fd = now_.master.native_handle(), .events = 0, .revents = 0};
    const bool nobody = ::poll(&other_side, 1, 0) == 1 && (other_side.revents & POLLHUP) != 0;
    // Without a descriptor for it the tty hangs up, and comes back when there is one.
    if (!hold_open(open_slave(now_.path))) cut(Cut::rst);
    if (nobody) make_raw(now_.slave.native_handle());
    if (!nobody && exclusive != 0) ::ioctl(now_.slave.native_handle(), TIOCEXCL);
    return !nobody;
}

// Where both the one before and the next one have written since the tty was looked at, nobody can
// tell whose bytes are whose, and neither is heard: drivers ask again, and none of them gets over
// an answer to another one's request.
void PtyPort::drop_input(bool waits) {
    if (waits) ::tcflush(now_.master.native_handle(), TCIFLUSH);
    if (connection()) connection()->drop_input();
}

void PtyPort::last_one_closed() {
    if (Connection* const client = connection())
        line().link.stop_on_close ? client->hang_up() : client->forget();
    clean_tty();
}

// A tty forgets its settings with its last close; this one is still open here, so that it is for us
// to undo what a driver did.
//
// A hang-up (vhangup) cuts off whoever has the tty open, which we are as well, and takes the
// settings back. Opened before it is closed: without anybody the tty would end. Where it cannot be
// opened the next close tries again.
void PtyPort::clean_tty() {
    if (hung_up(now_.slave.native_handle())) (void)hold_open(open_slave(now_.path));
    const int slave = now_.slave.native_handle();
    ::tcflush(slave, TCIFLUSH);
    ::tcflow(slave, TCOON);
    ::ioctl(slave, TIOCNXCL);
    make_raw(slave);
}

bool PtyPort::hold_open(int slave) {
    if (slave < 0) return false;
    error_code error;
    now_.slave.close(error);
    now_.slave.assign(slave, error);
    if (error) {
        ::close(slave);
        return false;
    }
    watch_for_hang_up();
    return true;
}

// Those that were cut off may keep their descriptors for long.
void PtyPort::watch_for_hang_up() {
    now_.slave.async_wait(asio::posix::stream_descriptor::wait_error,
                          [self = shared_from_this(), made = made_](error_code error) {
                              if (error || made != self->made_) return;
                              self->somebody_there();
                              if (hung_up(self->now_.slave.native_handle()))
                                  self->last_one_closed();
                          });
}

}  // namespace scipd::daemon
