// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/proxy/far_end.h"

#include <cerrno>
#include <utility>
#include <variant>

#include <boost/asio/buffer.hpp>
#include <boost/asio/connect.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/write.hpp>
#include <sys/socket.h>
#include <unistd.h>

#include "protocol/client/error.h"
#include "tools/set_line_rate.h"

namespace scipd::tools {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

namespace {

// A driver that reads too slowly holds up the scanner, as without a proxy: the kernel must not take
// minutes of scans for it.
constexpr int kernel_buffer_bytes = 64 * 1024;

// The other side of a pty that is gone reads as EIO, and so does a USB device.
std::string why_gone(const error_code& error) {
    const bool ended = error == asio::error::eof || error.value() == EIO;
    return ended ? "it has closed the connection" : "the connection broke: " + error.message();
}

}  // namespace

FarEnd::FarEnd(const asio::any_io_executor& executor, Hooks hooks)
    : hooks_(std::move(hooks)),
      resolver_(executor),
      socket_(executor),
      patience_(executor),
      stream_(executor) {}

void FarEnd::open(const Target& target, const OpenOptions& options) {
    std::visit([&](const auto& place) { open(place, options); }, target);
}

void FarEnd::open(const TcpTarget& target, const OpenOptions& options) {
    place_ = target.host + " port " + target.port;
    patience_.expires_after(options.connect_timeout);
    patience_.async_wait([self = shared_from_this()](const error_code& error) {
        if (!error) self->lose(self->place_ + " does not answer");
    });
    resolver_.async_resolve(
        target.host, target.port,
        [self = shared_from_this()](const error_code& error, const auto& places) {
            if (self->closed_) return;
            if (error) return self->lose("there is no host for " + self->place_);
            self->connect(places);
        });
}

void FarEnd::connect(const tcp::resolver::results_type& places) {
    asio::async_connect(
        socket_, places, [self = shared_from_this()](error_code error, const tcp::endpoint&) {
            if (self->closed_) return;
            if (error)
                return self->lose("cannot connect to " + self->place_ + ": " + error.message());
            self->patience_.cancel();
            self->socket_.set_option(tcp::no_delay(true), error);
            self->socket_.set_option(tcp::socket::receive_buffer_size(kernel_buffer_bytes), error);
            self->take(self->socket_.release());
        });
}

void FarEnd::open(const TtyTarget& target, const OpenOptions& options) {
    try {
        const int descriptor = open_target(target, options)->release();
        asio::post(stream_.get_executor(), [self = shared_from_this(), descriptor] {
            if (!self->closed_) return self->take(descriptor);
            const asio::posix::stream_descriptor closes(self->stream_.get_executor(), descriptor);
        });
    } catch (const protocol::client::Error& error) {
        lose_soon(error.what());
    }
}

void FarEnd::take(int descriptor) {
    stream_.assign(descriptor);
    stream_.non_blocking(true);
    hooks_.opened();
    if (closed_) return;
    write_on();
    read();
}

void FarEnd::close() {
    closed_ = true;
    resolver_.cancel();
    patience_.cancel();
    error_code ignored;
    socket_.close(ignored);
    stream_.close(ignored);
}

void FarEnd::lose(const std::string& why) {
    if (closed_) return;
    close();
    hooks_.lost(why);
}

void FarEnd::lose_soon(const std::string& why) {
    asio::post(stream_.get_executor(), [self = shared_from_this(), why] { self->lose(why); });
}

// It goes on only when what has been read was heard: until then, its bytes are in input_.
void FarEnd::read() {
    if (reading_ || paused_ || closed_ || !stream_.is_open()) return;
    reading_ = true;
    stream_.async_read_some(asio::buffer(input_), [self = shared_from_this()](
                                                      const error_code& error, std::size_t count) {
        if (self->closed_) return;
        if (count > 0) self->hooks_.heard({self->input_.data(), count});
        self->reading_ = false;
        if (error) return self->lose(why_gone(error));
        self->read();
    });
}

void FarEnd::resume() {
    paused_ = false;
    read();
}

// Most of what is written is written here: no turn of the loop lies between a driver's request and
// its way to the scanner.
void FarEnd::write(std::string_view bytes) {
    if (closed_) return;
    if (unwritten() == 0 && stream_.is_open()) {
        error_code error;
        bytes.remove_prefix(stream_.write_some(asio::buffer(bytes), error));
        if (error && error != asio::error::would_block) return;  // reading tells
    }
    waiting_ += bytes;
    write_on();
}

void FarEnd::write_on() {
    if (!writing_.empty() || closed_ || !stream_.is_open()) return;
    if (waiting_.empty()) {
        if (ends_writing_) ::shutdown(stream_.native_handle(), SHUT_WR);
        return;
    }
    writing_.swap(waiting_);
    async_write(stream_, asio::buffer(writing_),
                [self = shared_from_this()](const error_code& /*reading tells*/, std::size_t) {
                    self->writing_.clear();
                    if (self->closed_) return;
                    self->write_on();
                    if (self->unwritten() == 0) self->hooks_.drained();
                });
}

bool FarEnd::set_rate(int bits_per_second) {
    if (::isatty(stream_.native_handle()) == 0) return true;
    return set_line_rate(stream_.native_handle(), bits_per_second);
}

void FarEnd::end_writing() {
    ends_writing_ = true;
    write_on();
}

}  // namespace scipd::tools
