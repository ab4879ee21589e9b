// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One client of the HTTP server, over TCP or a Unix socket. It reads a request and writes its
// response, again and again, until either side ends the connection. Keeps itself alive. Lives on
// the I/O thread.
//
// Not a coroutine: Asio 1.74 has none with clang, which fuzzes and checks these sources.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include <boost/asio/generic/stream_protocol.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/basic_stream.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http.hpp>

#include "daemon/config/address.h"
#include "daemon/http/http_service.h"

namespace scipd::daemon {

/// Tells whether a client that waits for an answer is still there.
class Presence {
  public:
    /// A client of HTTP/1.1 understands interim answers (RFC 9110, 15.2).
    explicit Presence(bool understands_interim = false) : may_ask_(understands_interim) {}

    /// True if no client can read an answer. One that has only ended its own side may still read. A
    /// client of TCP that has closed looks the same until it is sent something: it is sent an
    /// interim answer, once. To be called while nothing else is sent.
    [[nodiscard]] bool has_gone(int socket);

  private:
    bool may_ask_;
};

/// The time until which a client may send or take some more of a message. A message may be of any
/// size, but in each stretch of patience much of it must pass: so a client that is slow on purpose
/// keeps nothing for long.
class HttpPace {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// A new message begins.
    void begin(std::chrono::milliseconds patience) {
        patience_ = patience;
        passed_ = 0;
        end_ = std::chrono::steady_clock::now() + patience;
    }
    void pass(std::size_t bytes) {
        passed_ += bytes;
        if (passed_ >= enough) begin(patience_);
    }
    [[nodiscard]] Time end() const { return end_; }

  private:
    /// With a patience of a minute 17 kB a second, which the worst networks have.
    static constexpr std::size_t enough = 1'048'576;

    std::chrono::milliseconds patience_{};
    std::size_t passed_ = 0;
    Time end_{};
};

class HttpConnection : public HttpClient, public std::enable_shared_from_this<HttpConnection> {
  public:
    /// Any: what Beast makes of a protocol takes long to compile, so it makes it once.
    using Protocol = boost::asio::generic::stream_protocol;

    /// `here` is where the client has connected to.
    HttpConnection(Protocol::socket socket, Address here, std::shared_ptr<HttpService> service,
                   SharedDoor door);
    ~HttpConnection() override;

    void read_header();
    /// Tells the client why nothing is read from it, and closes.
    void turn_away(HttpResponse why);
    void close() override { stream_.close(); }

  private:
    using Error = boost::system::error_code;

    [[nodiscard]] std::size_t most_of_header() const {
        return (*service_->limits)[Limit::http_header_bytes];
    }
    void read_more();
    void parse();
    void skip_empty_lines();
    void come_in();
    void allow_body();
    void read_body();
    void answer();
    void watch();
    void upgrade();
    void refuse(const Error& error);
    void write(HttpResponse plain, bool keep_alive);
    void write_more(bool keep_alive);
    void close_gently();
    void drop_input();

    std::shared_ptr<HttpService> service_;
    SharedDoor door_;
    Address here_;
    boost::beast::basic_stream<Protocol> stream_;
    boost::beast::flat_buffer buffer_;
    std::optional<boost::beast::http::request_parser<boost::beast::http::string_body>> parser_;
    std::chrono::milliseconds patience_{};
    HttpPace pace_;          ///< of the request, then of its answer
    std::size_t room_ = 0;   ///< for what is left of the header, or for what frames a chunk
    bool with_body_ = true;  ///< its answer, unless it is to HEAD
    bool wants_web_socket_ = false;
    const std::shared_ptr<Rate> rate_ = std::make_shared<Rate>();
    bool answered_ = false;
    std::stop_source hung_up_;
    Presence presence_;                 ///< of who waits for the answer
    boost::asio::steady_timer glance_;  ///< when to look whether it has
    boost::beast::http::response<boost::beast::http::empty_body> go_on_;
    boost::beast::http::response<boost::beast::http::string_body> response_;
    std::optional<boost::beast::http::response_serializer<boost::beast::http::string_body>>
        serializer_;
};

}  // namespace scipd::daemon
