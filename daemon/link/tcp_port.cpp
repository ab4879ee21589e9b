// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/link/tcp_port.h"

#include <chrono>
#include <stdexcept>
#include <utility>

namespace scipd::daemon {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

namespace {

// Enough for a driver that reconnects before its old connection is gone.
constexpr int backlog = 4;

// A scanner has little memory: without a bound the kernel would keep minutes of scans for a client
// that does not read, and hand it all of them, long out of date.
constexpr int kernel_buffer_bytes = 64 * 1024;

// After a failed accept, as when all descriptors are taken: not at once again.
constexpr std::chrono::milliseconds accept_pause{100};

}  // namespace

TcpPort::TcpPort(const asio::any_io_executor& executor, const Address& address)
    : acceptor_(executor), pause_(executor), peer_timer_(executor) {
    try {
        const tcp::endpoint endpoint(asio::ip::make_address(address.host), address.port);
        acceptor_.open(endpoint.protocol());
        acceptor_.set_option(tcp::acceptor::reuse_address(true));
        acceptor_.bind(endpoint);
        acceptor_.listen(backlog);
    } catch (const boost::system::system_error& error) {
        throw std::runtime_error("cannot listen on " + text_of(address) + ": " +
                                 error.code().message() +
                                 "; choose another address, or port 0 for any");
    }
}

void TcpPort::serve(Endpoint& scanner, const LinkConfig& link) {
    disconnect();
    scanner_ = &scanner;
    link_ = link;
    link_.baud.reset();  // a tty's
    accept();
}

void TcpPort::stop() {
    error_code ignored;
    acceptor_.close(ignored);
    pause_.cancel();
    disconnect();
    scanner_ = nullptr;
}

std::string TcpPort::address() const {
    const tcp::endpoint endpoint = acceptor_.local_endpoint();
    return text_of(Address{endpoint.address().to_string(), endpoint.port()});
}

void TcpPort::accept() {
    if (accepting_ || connected()) return;
    accepting_ = true;
    acceptor_.async_accept([self = shared_from_this()](error_code error, tcp::socket socket) {
        self->accepting_ = false;
        if (error == asio::error::operation_aborted || !self->scanner_) return;
        if (error) return self->accept_later();
        self->connect(std::move(socket));
    });
}

void TcpPort::accept_later() {
    pause_.expires_after(accept_pause);
    pause_.async_wait([self = shared_from_this()](error_code error) {
        if (!error && self->scanner_) self->accept();
    });
}

void TcpPort::connect(tcp::socket socket) {
    error_code error;
    socket.set_option(tcp::no_delay(true), error);
    socket.set_option(tcp::socket::send_buffer_size(kernel_buffer_bytes), error);
    const auto executor = socket.get_executor();
    const int descriptor = socket.release(error);
    if (error) return accept();
    begin(std::make_shared<Connection>(Connection::Descriptor(executor, descriptor), *scanner_,
                                       link_, Connection::Hooks{.ended = [this] {
                                           disconnect();
                                           accept();
                                       }}));
    watch(descriptor);
}

// It looks so often that it notices at most an eighth too late.
void TcpPort::watch(int socket) {
    if (link_.dead_after == link_.dead_after.zero()) return;
    peer_.emplace(socket, link_.dead_after);
    watch_on();
}

void TcpPort::watch_on() {
    peer_timer_.expires_after(link_.dead_after / 8);
    peer_timer_.async_wait([self = shared_from_this()](error_code error) {
        if (error || !self->peer_) return;
        if (!self->peer_->stalled()) return self->watch_on();
        self->disconnect();
        self->accept();
    });
}

void TcpPort::disconnect() {
    end_connection();
    peer_.reset();
    peer_timer_.cancel();
}

}  // namespace scipd::daemon
