// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One WebSocket over the stream that an HTTP request came by. It reads messages for a conversation
// and writes what the conversation sends. Keeps itself alive. Lives on the I/O thread.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <utility>

#include <boost/asio/generic/stream_protocol.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/basic_stream.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

#include "daemon/http/http_service.h"

namespace scipd::daemon {

class WebSocketConnection : public HttpClient,
                            public WebSocket,
                            public std::enable_shared_from_this<WebSocketConnection> {
  public:
    using Stream = boost::beast::basic_stream<boost::asio::generic::stream_protocol>;
    using Request = boost::beast::http::request<boost::beast::http::string_body>;

    WebSocketConnection(Stream stream, std::shared_ptr<HttpService> service, SharedDoor door);
    ~WebSocketConnection() override;

    /// Begins the conversation and accepts the request.
    void open(const Request& request, Converse converse);

    void send(std::shared_ptr<const std::string> message) override {
        enqueue({std::move(message), false});
    }
    void send_bytes(std::shared_ptr<const std::string> message) override {
        enqueue({std::move(message), true});
    }
    void cut() override;
    void close() override;

  private:
    using Error = boost::system::error_code;
    struct Message {
        std::shared_ptr<const std::string> content;
        bool binary;
    };

    void accepted(const Error& error);
    void enqueue(Message message);
    void read();
    void read_more();
    void received(const Error& error);
    /// A message, a ping or a pong has come.
    void count();
    void work_off();
    void write();
    void written(const Error& error);
    /// Closes, and tells the client why.
    void refuse(Limit limit, boost::beast::websocket::close_code code =
                                 boost::beast::websocket::close_code::policy_error);
    void tell_why();

    std::shared_ptr<HttpService> service_;
    SharedDoor door_;
    boost::beast::websocket::stream<Stream> socket_;
    boost::beast::flat_buffer buffer_;
    std::deque<Message> queue_;
    std::size_t queue_bytes_ = 0;
    Rate rate_;              ///< of what comes
    bool accepted_ = false;  ///< whether the client has its answer
    bool refused_ = false;
    boost::beast::websocket::close_reason reason_;  ///< why it is refused
    boost::asio::steady_timer patience_;  ///< with a client that is refused and does not read
    bool waits_for_room_ = false;         ///< whether it reads on once the queue is shorter
    std::unique_ptr<Conversation> conversation_;
};

}  // namespace scipd::daemon
