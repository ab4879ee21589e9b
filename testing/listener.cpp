// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "testing/listener.h"

#include <atomic>
#include <chrono>
#include <thread>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket.hpp>
#include <poll.h>
#include <sys/socket.h>

namespace scipd::testing {
namespace {

namespace websocket = boost::beast::websocket;
using boost::asio::local::stream_protocol;

}  // namespace

struct Listener::Connection {
    boost::asio::io_context io;
    websocket::stream<stream_protocol::socket> stream{io};
    Hear hear;
    int descriptor = -1;
    std::atomic<bool> waits{false};
    std::thread thread;

    void listen() {
        boost::beast::flat_buffer buffer;
        boost::system::error_code error;
        for (;;) {
            waits = true;
            stream.read(buffer, error);
            waits = false;
            if (error) break;
            hear(boost::beast::buffers_to_string(buffer.data()));
            buffer.clear();
        }
        waits = true;
    }

    /// Whether the thread waits for something that has not come.
    [[nodiscard]] bool is_idle() const {
        pollfd event{.fd = descriptor, .events = POLLIN, .revents = 0};
        return waits && (::poll(&event, 1, 0) <= 0 || (event.revents & POLLHUP) != 0);
    }
};

Listener::Listener(const std::string& socket, const std::string& target, Hear hear)
    : connection_(std::make_unique<Connection>()) {
    Connection& connection = *connection_;
    connection.hear = std::move(hear);
    connection.stream.next_layer().connect(stream_protocol::endpoint(socket));
    connection.stream.handshake("localhost", target);
    connection.descriptor = connection.stream.next_layer().native_handle();
    connection.thread = std::thread([&connection] { connection.listen(); });
}

Listener::~Listener() {
    ::shutdown(connection_->descriptor, SHUT_RDWR);
    connection_->thread.join();
}

void Listener::catch_up() const {
    // Between coming and being heard a message is nowhere to be seen for a moment.
    for (int i = 0; i < 2; ++i) {
        while (!connection_->is_idle())
            std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
}

}  // namespace scipd::testing
