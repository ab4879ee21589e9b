// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipctl/control_client.h"

#include <cctype>
#include <chrono>
#include <string_view>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/beast/core/basic_stream.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http.hpp>

namespace scipd::tools {
namespace {

namespace asio = boost::asio;
namespace http = boost::beast::http;
using asio::local::stream_protocol;
using boost::system::error_code;

constexpr std::chrono::seconds patience{10};
constexpr unsigned http_1_1 = 11;

using Request = http::request<http::string_body>;
using Response = http::response<http::string_body>;

/// The detail of a problem document (RFC 9457), or what comes nearest.
std::string sentence_of(const Response& response) {
    const std::string reason(response.reason());
    const auto document = nlohmann::json::parse(response.body(), nullptr, false);
    if (!document.is_object()) return "scipd answers " + std::to_string(response.result_int());
    const auto text = [&](const char* key) {
        return document.contains(key) && document[key].is_string()
                   ? document[key].get<std::string>()
                   : std::string();
    };
    const std::string title = text("title").empty() ? reason : text("title");
    return text("detail").empty() ? title : title + ": " + text("detail");
}

}  // namespace

struct ControlClient::Connection {
    asio::io_context io;
    boost::beast::basic_stream<stream_protocol> stream{io};
    boost::beast::flat_buffer buffer;

    /// Runs one operation to its end, no longer than `patience`.
    template <typename Operation>
    error_code complete(Operation operation) {
        error_code result;
        stream.expires_after(patience);
        operation([&](const error_code& error, auto...) { result = error; });
        io.restart();
        io.run();
        return result;
    }
    error_code connect(const std::filesystem::path& socket) {
        const stream_protocol::endpoint endpoint(socket.string());
        return complete([&](auto done) { stream.async_connect(endpoint, done); });
    }
    Response exchange(const Request& request, error_code& error) {
        Response response;
        error = complete([&](auto done) { http::async_write(stream, request, done); });
        if (error) return response;
        error = complete([&](auto done) { http::async_read(stream, buffer, response, done); });
        // Beast moves the message into its parser and, which the analyser does not see, back.
        return response;  // NOLINT(clang-analyzer-cplusplus.Move)
    }
};

ControlClient::ControlClient(std::filesystem::path socket) : socket_(std::move(socket)) {}

ControlClient::~ControlClient() = default;

ControlClient::Json ControlClient::get(const std::string& path) {
    auto document = Json::parse(exchange(false, path, {}), nullptr, false);
    if (document.is_discarded()) throw unreachable("what answers is no scipd");
    return document;
}

void ControlClient::put(const std::string& path, const Json& body) {
    (void)exchange(true, path, body.dump());
}

// scipd ends a connection that is idle for long; then a new one is as good. All requests may be
// sent twice without harm.
std::string ControlClient::exchange(bool is_put, const std::string& path, const std::string& body) {
    Request request(is_put ? http::verb::put : http::verb::get, path, http_1_1);
    request.set(http::field::host, "localhost");
    if (is_put) request.set(http::field::content_type, "application/json");
    request.body() = body;
    request.prepare_payload();

    Response response;
    error_code error;
    if (connection_) response = connection_->exchange(request, error);
    if (!connection_ || error) {
        connection_ = std::make_unique<Connection>();
        error = connection_->connect(socket_);
        if (error) throw unreachable(error.message());
        response = connection_->exchange(request, error);
    }
    if (error) throw unreachable(error.message());
    if (!response.keep_alive()) connection_.reset();
    if (response.result_int() >= 400) {
        throw ControlError(static_cast<int>(response.result_int()), sentence_of(response));
    }
    return response.body();
}

ControlError ControlClient::unreachable(const std::string& why) const {
    return {0, "cannot reach scipd at " + socket_.string() + ": " + why +
                   " (does it run? --control names another socket)"};
}

std::string path_segment(const std::string& text) {
    constexpr std::string_view unreserved = "-._~";
    constexpr std::string_view digits = "0123456789ABCDEF";
    std::string segment;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (std::isalnum(byte) != 0 || unreserved.find(c) != std::string_view::npos) {
            segment.push_back(c);
        } else {
            segment.append({'%', digits[byte >> 4U], digits[byte & 0xFU]});
        }
    }
    return segment;
}

}  // namespace scipd::tools
