// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/control_client.h"

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
/// Loading a large world takes minutes.
constexpr std::chrono::minutes long_patience{10};
constexpr unsigned http_1_1 = 11;

using Request = http::request<http::string_body>;
using Response = http::response<http::string_body>;

/// The detail of a problem document (RFC 9457) with those of its errors that it does not tell, or
/// the next best text. Its title only repeats the status.
std::string sentence_of(const Response& response) {
    const auto document = nlohmann::json::parse(response.body(), nullptr, false);
    if (!document.is_object()) return "scipd answers " + std::to_string(response.result_int());
    const auto text = [&](const char* key) {
        return document.contains(key) && document[key].is_string()
                   ? document[key].get<std::string>()
                   : std::string();
    };
    std::string sentence = text("detail").empty() ? text("title") : text("detail");
    if (sentence.empty()) sentence = std::string(response.reason());
    if (sentence.find(text("field")) == std::string::npos) sentence.insert(0, text("field") + ": ");
    for (const auto& error : document.value("errors", nlohmann::json::array())) {
        const auto said = error.get<std::string>();
        if (sentence.find(said) == std::string::npos) sentence += "\n" + said;
    }
    return sentence;
}

}  // namespace

struct ControlClient::Connection {
    asio::io_context io;
    boost::beast::basic_stream<stream_protocol> stream{io};
    boost::beast::flat_buffer buffer;
    std::chrono::seconds limit = patience;

    /// Runs one operation to its end, but no longer than `limit`.
    template <typename Operation>
    error_code complete(Operation operation) {
        error_code result;
        stream.expires_after(limit);
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
        // Beast moves the message into its parser and back. The analyser does not see the way back.
        return response;  // NOLINT(clang-analyzer-cplusplus.Move)
    }
};

ControlClient::ControlClient(std::filesystem::path socket) : socket_(std::move(socket)) {}

ControlClient::~ControlClient() = default;

struct ControlClient::Question {
    http::verb method;
    std::string path;
    std::string body = {};
    /// An edit may take long, and must not be sent twice.
    bool is_edit = false;
};

ControlClient::Json ControlClient::get(const std::string& path) {
    auto document = Json::parse(text(path), nullptr, false);
    if (document.is_discarded()) throw unreachable("the program that answers is not scipd");
    return document;
}

std::string ControlClient::text(const std::string& path) {
    return exchange({http::verb::get, path});
}

void ControlClient::put(const std::string& path, const Json& body) {
    (void)exchange({http::verb::put, path, body.dump()});
}

ControlClient::Json ControlClient::load(const std::string& path, const Json& body) {
    return Json::parse(exchange({http::verb::put, path, body.dump(), true}), nullptr, false);
}

ControlClient::Json ControlClient::post(const std::string& path, const Json& body) {
    return Json::parse(exchange({http::verb::post, path, body.dump(), true}), nullptr, false);
}

ControlClient::Json ControlClient::patch(const std::string& path, const Json& body) {
    return Json::parse(exchange({http::verb::patch, path, body.dump(), true}), nullptr, false);
}

void ControlClient::remove(const std::string& path) {
    (void)exchange({http::verb::delete_, path, {}, true});
}

std::string ControlClient::ask(const std::string& method, const std::string& path,
                               const std::string& body) {
    const http::verb verb = http::string_to_verb(method);
    return exchange({verb, path, body, verb != http::verb::get});
}

// scipd closes a connection that is idle for long. Then this opens a new one.
std::string ControlClient::exchange(const Question& question) {
    Request request(question.method, question.path, http_1_1);
    request.set(http::field::host, "localhost");
    if (!question.body.empty()) request.set(http::field::content_type, "application/json");
    request.body() = question.body;
    request.prepare_payload();

    Response response;
    error_code error;
    if (question.is_edit) connection_.reset();
    if (connection_) response = connection_->exchange(request, error);
    if (!connection_ || error) {
        connection_ = std::make_unique<Connection>();
        error = connection_->connect(socket_);
        if (error) throw unreachable(error.message());
        if (question.is_edit) connection_->limit = long_patience;
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

std::string json_text(const ControlClient::Json& document, int indent) {
    return document.dump(indent, ' ', true);
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
