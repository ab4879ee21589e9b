// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/link/tcp_port.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <boost/asio/post.hpp>
#include <sys/poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace scipd::daemon {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

namespace {

// A scanner has little memory: without a bound the kernel would keep minutes of scans for a client
// that does not read, and hand it all of them, long out of date.
constexpr int kernel_buffer_bytes = 64 * 1024;

// After a failed accept, as when all descriptors are taken, or a failed listen: not at once again.
constexpr std::chrono::milliseconds listen_again_after{100};

// The kernel resets a connection that is closed with bytes that nobody has read.
void drop_unread(int socket) {
    constexpr int most_reads = 64;
    std::array<char, 4096> buffer;
    for (int i = 0; i < most_reads; ++i) {
        if (::recv(socket, buffer.data(), buffer.size(), MSG_DONTWAIT) <= 0) return;
    }
}

void reset_on_close(int socket) {
    const linger at_once{.l_onoff = 1, .l_linger = 0};
    ::setsockopt(socket, SOL_SOCKET, SO_LINGER, &at_once, sizeof(at_once));
}

// A client that only sends no more looks the same.
bool has_hung_up(tcp::socket& socket) {
    pollfd asked{.fd = socket.native_handle(), .events = POLLRDHUP, .revents = 0};
    return ::poll(&asked, 1, 0) == 1;
}

/// HOST:PORT
std::string peer_of(const tcp::socket& socket) {
    error_code error;
    const tcp::endpoint peer = socket.remote_endpoint(error);
    if (error) return "an unknown address";
    return text_of(Address{peer.address().to_string(), peer.port()});
}

bool has_left_silently(tcp::socket& socket) {
    error_code ignored;
    return has_hung_up(socket) && socket.available(ignored) == 0;
}

}  // namespace

TcpPort::TcpPort(const asio::any_io_executor& executor, const Address& address,
                 std::optional<int> handed)
    : acceptor_(executor), handed_(handed.has_value()), pause_(executor), peer_timer_(executor) {
    try {
        endpoint_ = {asio::ip::make_address(address.host), address.port};
        if (handed) {
            acceptor_.assign(endpoint_.protocol(), *handed);
        } else {
            listen();
        }
        endpoint_ = acceptor_.local_endpoint();
    } catch (const boost::system::system_error& error) {
        const std::string what = "cannot listen on " + text_of(address);
        require_own_address(what, error.code());
        const bool taken = error.code() == asio::error::address_in_use;
        throw std::runtime_error(what + ": " + error.code().message() +
                                 (taken ? ", maybe by another scipd" : "") +
                                 "; choose another address, or port 0 for a free one, such as "
                                 "--tcp 127.0.0.1:0");
    }
}

std::shared_ptr<TcpPort> TcpPort::moved_to(const asio::any_io_executor& executor) {
    const Address address{endpoint_.address().to_string(), endpoint_.port()};
    std::optional<int> socket;
    // While it refuses clients, nothing listens there.
    if (acceptor_.is_open()) socket = ::dup(acceptor_.native_handle());
    if (socket == -1) {
        throw std::runtime_error("cannot move the port " + text_of(address) + ": " +
                                 std::generic_category().message(errno));
    }
    auto moved = std::make_shared<TcpPort>(executor, address, socket);
    moved->handed_ = handed_;
    moved->count_on_from(*this);
    moved_to_ = moved;
    return moved;
}

void TcpPort::serve(Endpoint& scanner, const LinkConfig& link) {
    disconnect(Leaving::ended);
    scanner_ = &scanner;
    set_line({.link = link});
    serve_next();
    accept();
}

void TcpPort::stop() {
    close();
    pause_.cancel();
    for (tcp::socket& socket : waiting_)
        pass_on(std::move(socket));
    waiting_.clear();
    disconnect(Leaving::ended);
    scanner_ = nullptr;
}

std::string TcpPort::address() const {
    return text_of(Address{endpoint_.address().to_string(), endpoint_.port()});
}

// Not those that have closed their side: they want answers at most.
std::vector<std::string> TcpPort::waiting() {
    std::vector<std::string> clients;
    for (tcp::socket& socket : waiting_) {
        if (!has_hung_up(socket)) clients.push_back(peer_of(socket));
    }
    return clients;
}

void TcpPort::cut(Cut how) {
    if (!connection()) return;
    connection()->abandon();
    asio::post(acceptor_.get_executor(),
               [self = shared_from_this(), how, client = connection()->weak_from_this()] {
                   const auto cut_off = client.lock();
                   if (!cut_off || cut_off.get() != self->connection()) return;
                   how == Cut::fin ? drop_unread(cut_off->descriptor())
                                   : reset_on_close(cut_off->descriptor());
                   self->disconnect(Leaving::cut);
                   self->serve_next();
               });
}

void TcpPort::follow_line() {
    if (!scanner_) return;
    if (line().refuses) {
        if (!handed_) close();
        turn_all_away();
    } else if (!acceptor_.is_open()) {
        listen_again();
    }
}

void TcpPort::listen_again() {
    try {
        listen();
        accept();
    } catch (const boost::system::system_error&) {
        pause_.expires_after(listen_again_after);
        pause_.async_wait([self = shared_from_this()](error_code error) {
            if (!error) self->follow_line();
        });
    }
}

void TcpPort::listen() {
    acceptor_.open(endpoint_.protocol());
    try {
        acceptor_.set_option(tcp::acceptor::reuse_address(true));
        acceptor_.bind(endpoint_);
        acceptor_.listen();
    } catch (const boost::system::system_error&) {
        acceptor_.close();
        throw;
    }
}

// Where it has moved, the socket is still open. If it was only closed here, epoll would go on
// telling of it, and would not take it again under the same number.
void TcpPort::close() {
    if (acceptor_.is_open()) ::close(acceptor_.release());
}

void TcpPort::accept() {
    if (accepting_ || !acceptor_.is_open()) return;
    accepting_ = true;
    acceptor_.async_accept([self = shared_from_this()](error_code error, tcp::socket socket) {
        self->accepting_ = false;
        if (!self->scanner_ && !error) return self->pass_on(std::move(socket));
        if (!self->scanner_ || (self->line().refuses && !self->handed_)) return;
        // It refused clients for a while.
        if (error == asio::error::operation_aborted) return self->accept();
        if (error) {
            // Their descriptors may be those that are missing.
            std::erase_if(self->waiting_, has_hung_up);
            return self->accept_later();
        }
        self->take_in(std::move(socket));
        self->accept();
    });
}

void TcpPort::take_in(tcp::socket socket) {
    // Where somebody else holds the socket open, it goes on listening while the line refuses.
    if (line().refuses) return reset_on_close(socket.native_handle());
    if (!connected()) return connect(std::move(socket));
    if (!make_room()) return void(limits().refuse(Limit::scanner_connections, address()));
    tell_waits(peer_of(socket));
    waiting_.push_back(std::move(socket));
}

void TcpPort::pass_on(tcp::socket socket) {
    const auto there = moved_to_.lock();
    if (!there) return reset_on_close(socket.native_handle());
    asio::post(there->acceptor_.get_executor(), [there, descriptor = socket.release()] {
        tcp::socket here(there->acceptor_.get_executor(), there->endpoint_.protocol(), descriptor);
        // It may have moved on by now.
        there->scanner_ ? there->take_in(std::move(here)) : there->pass_on(std::move(here));
    });
}

void TcpPort::serve_next() {
    if (connected() || waiting_.empty()) return;
    tcp::socket socket = std::move(waiting_.front());
    waiting_.pop_front();
    connect(std::move(socket));
}

// One that hung up after it had said something goes only where there is need: until then, it is to
// get the answers.
bool TcpPort::make_room() {
    const auto is_room = [&] { return waiting_.size() + 1 < limits()[Limit::scanner_connections]; };
    std::erase_if(waiting_, has_left_silently);
    if (!is_room()) std::erase_if(waiting_, has_hung_up);
    return is_room();
}

// As the kernel does with those whom nobody has accepted.
void TcpPort::turn_all_away() {
    for (tcp::socket& socket : waiting_)
        reset_on_close(socket.native_handle());
    waiting_.clear();
}

void TcpPort::accept_later() {
    pause_.expires_after(listen_again_after);
    pause_.async_wait([self = shared_from_this()](error_code error) {
        if (!error && self->scanner_) self->accept();
    });
}

void TcpPort::connect(tcp::socket socket) {
    error_code error;
    const std::string from = peer_of(socket);
    socket.set_option(tcp::no_delay(true), error);
    socket.set_option(tcp::socket::send_buffer_size(kernel_buffer_bytes), error);
    const auto executor = socket.get_executor();
    const int descriptor = socket.release(error);
    if (error) return serve_next();
    LinkConfig link = line().link;
    link.baud.reset();  // a tty's
    begin(std::make_shared<Connection>(Connection::Descriptor(executor, descriptor), *scanner_,
                                       link, Connection::Hooks{.ended = [this](Leaving why) {
                                           disconnect(why);
                                           serve_next();
                                       }}));
    watch(descriptor);
    tell_connected(from);
}

// It looks so often that it notices at most an eighth too late.
void TcpPort::watch(int socket) {
    dead_after_ = line().link.dead_after;
    if (dead_after_ == dead_after_.zero()) return;
    peer_.emplace(socket, dead_after_);
    watch_on();
}

void TcpPort::watch_on() {
    peer_timer_.expires_after(dead_after_ / 8);
    peer_timer_.async_wait([self = shared_from_this()](error_code error) {
        if (error || !self->peer_) return;
        if (!self->peer_->stalled()) return self->watch_on();
        self->disconnect(Leaving::silent);
        self->serve_next();
    });
}

void TcpPort::disconnect(Leaving why) {
    end_connection(why);
    peer_.reset();
    peer_timer_.cancel();
}

}  // namespace scipd::daemon
