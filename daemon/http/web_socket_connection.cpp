// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/http/web_socket_connection.h"

#include <algorithm>
#include <chrono>
#include <string_view>
#include <utility>

#include <boost/asio/buffer.hpp>
#include <boost/asio/post.hpp>

namespace scipd::daemon {
namespace {

namespace asio = boost::asio;
namespace websocket = boost::beast::websocket;

/// A client with so many messages before it is not listened to until it has read some.
constexpr std::size_t most_unread = 64;

/// What it reads at most. Without a bound the library makes room for all that a frame says will
/// come, which may be 2^64 bytes.
constexpr std::size_t most_at_once = 65'536;

/// How long a client may take to read why it is refused.
constexpr std::chrono::seconds last_words{5};

}  // namespace

WebSocketConnection::WebSocketConnection(Stream stream, std::shared_ptr<HttpService> service,
                                         SharedDoor door)
    : service_(std::move(service)),
      door_(std::move(door)),
      socket_(std::move(stream)),
      patience_(socket_.get_executor()) {
    service_->clients.insert(this);
    boost::beast::get_lowest_layer(socket_).expires_never();
    socket_.set_option(websocket::stream_base::timeout::suggested(boost::beast::role_type::server));
    // It would end the connection without the reason.
    constexpr std::size_t no_limit = 0;
    socket_.read_message_max(no_limit);
    socket_.auto_fragment(false);
    socket_.control_callback([this](websocket::frame_type type, auto) {
        if (type != websocket::frame_type::close) count();
    });
}

WebSocketConnection::~WebSocketConnection() {
    service_->clients.erase(this);
}

void WebSocketConnection::open(const Request& request, Converse converse) {
    const auto offers = subprotocols(request);
    if (std::ranges::find(offers, own_subprotocol) != offers.end()) {
        socket_.set_option(websocket::stream_base::decorator([](websocket::response_type& answer) {
            answer.set(boost::beast::http::field::sec_websocket_protocol, own_subprotocol);
        }));
    }
    // The conversation begins first: who has the answer misses nothing that happens afterwards.
    conversation_ = converse(*this);
    socket_.async_accept(
        request, [self = shared_from_this()](const Error& error) { self->accepted(error); });
}

void WebSocketConnection::accepted(const Error& error) {
    if (error || service_->closed) return conversation_.reset();
    accepted_ = true;
    if (refused_) return tell_why();
    if (!queue_.empty()) write();
    read();
}

void WebSocketConnection::read() {
    waits_for_room_ = queue_.size() >= most_unread;
    if (!waits_for_room_) read_more();
}

void WebSocketConnection::read_more() {
    socket_.async_read_some(
        buffer_, most_at_once,
        [self = shared_from_this()](const Error& error, std::size_t) { self->received(error); });
}

void WebSocketConnection::received(const Error& error) {
    // The conversation may hold what refers to others that end before the last handler does.
    if (error || service_->closed || refused_) return conversation_.reset();
    if (buffer_.size() > (*service_->limits)[Limit::http_body_bytes])
        return refuse(Limit::http_body_bytes, websocket::close_code::too_big);
    if (!socket_.is_message_done()) return read_more();
    count();
    if (!refused_) work_off();
}

void WebSocketConnection::count() {
    constexpr Limit limit = Limit::websocket_messages_per_s;
    if (!refused_ && !rate_.admit((*service_->limits)[limit])) refuse(limit);
}

/// A long message in many turns of the event loop.
void WebSocketConnection::work_off() {
    // It has ended with a write that failed, while this message had already come.
    if (!conversation_) return;
    const auto bytes = buffer_.cdata();
    buffer_.consume(conversation_->take({static_cast<const char*>(bytes.data()), bytes.size()}));
    if (buffer_.size() == 0) return read();
    asio::post(socket_.get_executor(), [self = shared_from_this()] { self->work_off(); });
}

void WebSocketConnection::enqueue(Message message) {
    const std::size_t bytes = queue_bytes_ + message.content->size();
    if (refused_) return;
    // A single message may be of any size.
    if (!queue_.empty() && bytes > (*service_->limits)[Limit::websocket_queue_bytes])
        return refuse(Limit::websocket_queue_bytes);
    queue_bytes_ = bytes;
    queue_.push_back(std::move(message));
    if (accepted_ && queue_.size() == 1) write();
}

void WebSocketConnection::write() {
    socket_.binary(queue_.front().binary);
    socket_.async_write(
        asio::buffer(*queue_.front().content),
        [self = shared_from_this()](const Error& error, std::size_t) { self->written(error); });
}

void WebSocketConnection::written(const Error& error) {
    if (error || service_->closed) return conversation_.reset();
    queue_bytes_ -= queue_.front().content->size();
    queue_.pop_front();
    if (!queue_.empty()) write();
    if (!conversation_) return;
    conversation_->left();
    if (waits_for_room_) read();
}

void WebSocketConnection::refuse(Limit limit, websocket::close_code code) {
    refused_ = true;
    const std::string why = service_->limits->refuse(limit, door_->name);
    reason_.code = code;
    reason_.reason.assign(why.data(), std::min(why.size(), reason_.reason.max_size()));
    // In another turn, since the conversation itself may be sending.
    if (accepted_)
        asio::post(socket_.get_executor(), [self = shared_from_this()] { self->tell_why(); });
}

void WebSocketConnection::tell_why() {
    conversation_.reset();
    socket_.async_close(reason_,
                        [self = shared_from_this()](const Error&) { self->patience_.cancel(); });
    patience_.expires_after(last_words);
    patience_.async_wait([self = shared_from_this()](const Error& error) {
        if (!error) self->close();
    });
}

void WebSocketConnection::cut() {
    asio::post(socket_.get_executor(), [self = shared_from_this()] { self->close(); });
}

void WebSocketConnection::close() {
    conversation_.reset();
    boost::beast::get_lowest_layer(socket_).close();
}

}  // namespace scipd::daemon
