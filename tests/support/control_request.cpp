// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tests/support/control_request.h"

#include <stdexcept>

#include <boost/asio/io_context.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http.hpp>
#include <nlohmann/json.hpp>

namespace scipd::tests {

nlohmann::json control_get(const std::filesystem::path& socket, const std::string& path) {
    namespace http = boost::beast::http;
    using Local = boost::asio::local::stream_protocol;
    boost::asio::io_context io;
    Local::socket stream(io);
    stream.connect(Local::endpoint(socket.string()));

    http::request<http::empty_body> request{http::verb::get, path, 11};
    request.set(http::field::host, "localhost");
    request.keep_alive(false);
    http::write(stream, request);

    boost::beast::flat_buffer buffer;
    http::response<http::string_body> response;
    http::read(stream, buffer, response);
    if (response.result() != http::status::ok) {
        throw std::runtime_error("GET " + path + ": " + response.body());
    }
    return nlohmann::json::parse(response.body());
}

}  // namespace scipd::tests
