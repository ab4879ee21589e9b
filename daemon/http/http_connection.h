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
#include "daemon/http/http_pace.h"
#include "daemon/http/http_service.h"
#include "daemon/http/presence.h"

namespace scipd::daemon {

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
