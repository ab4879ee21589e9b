// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tests/support/control_request.h"

#include <stdexcept>

#include <boost/asio/io_context.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <nlohmann/json.hpp>

namespace scipd::tests {

namespace http = boost::beast::http;
using Local = boost::asio::local::stream_protocol;

ControlAnswer control_request(const std::filesystem::path& socket, const std::string& method,
                              const std::string& path, const std::string& body) {
    boost::asio::io_context io;
    Local::socket stream(io);
    stream.connect(Local::endpoint(socket.string()));

    http::request<http::string_body> request{http::string_to_verb(method), path, 11};
    request.set(http::field::host, "localhost");
    request.keep_alive(false);
    request.body() = body;
    request.prepare_payload();
    http::write(stream, request);

    boost::beast::flat_buffer buffer;
    http::response<http::string_body> response;
    http::read(stream, buffer, response);
    return {static_cast<int>(response.result_int()), response.body()};
}

nlohmann::json control_get(const std::filesystem::path& socket, const std::string& path) {
    const ControlAnswer answer = control_request(socket, "GET", path);
    if (answer.status != 200) throw std::runtime_error("GET " + path + ": " + answer.body);
    return nlohmann::json::parse(answer.body);
}

struct WebSocketClient::Connection {
    boost::asio::io_context io;
    boost::beast::websocket::stream<Local::socket> stream{io};
};

WebSocketClient::WebSocketClient(const std::filesystem::path& socket, const std::string& path)
    : connection_(std::make_unique<Connection>()) {
    connection_->stream.next_layer().connect(Local::endpoint(socket.string()));
    connection_->stream.handshake("localhost", path);
}

WebSocketClient::~WebSocketClient() = default;

void WebSocketClient::send(const std::string& message) {
    connection_->stream.write(boost::asio::buffer(message));
}

std::string WebSocketClient::receive() {
    boost::beast::flat_buffer buffer;
    connection_->stream.read(buffer);
    return boost::beast::buffers_to_string(buffer.data());
}

}  // namespace scipd::tests
