// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/http/http_connection.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <boost/beast/core/string.hpp>
#include <boost/beast/http/field.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <poll.h>
#include <sys/socket.h>

#include "daemon/http/http_message.h"
#include "daemon/http/problem.h"
#include "daemon/http/web_socket_connection.h"
#include "daemon/limits/rate.h"

namespace scipd::daemon {
namespace {

namespace asio = boost::asio;
namespace http = boost::beast::http;

/// `rate` is that of the client. Nobody can withdraw the request yet.
HttpRequest to_plain(const http::request<http::string_body>& request,
                     const std::shared_ptr<Rate>& rate) {
    const std::string target{request.target().data(), request.target().size()};
    const auto mark = target.find('?');
    // HEAD is GET without the body of the answer.
    const bool is_head = request.method() == http::verb::head;
    const std::string method{request.method_string().data(), request.method_string().size()};
    return {.method = is_head ? "GET" : method,
            .path = target.substr(0, mark),
            .query = mark == target.npos ? "" : target.substr(mark + 1),
            .body = request.body(),
            .if_none_match = std::string(request[http::field::if_none_match]),
            .withdrawn = {},
            .rate = rate};
}

http::response<http::string_body> to_beast(HttpResponse plain, bool keep_alive) {
    http::response<http::string_body> response;
    response.version(11);
    response.result(static_cast<unsigned>(plain.status));
    if (!plain.content_type.empty()) response.set(http::field::content_type, plain.content_type);
    if (!plain.allow.empty()) response.set(http::field::allow, plain.allow);
    if (plain.status == 426) response.set(http::field::upgrade, "websocket");
    for (const auto& [name, value] : plain.headers)
        response.set(name, value);
    if (!plain.body.empty()) response.set("X-Content-Type-Options", "nosniff");
    response.body() = std::move(plain.body);
    response.keep_alive(keep_alive);
    // A 204 has no length, not even 0 (RFC 9110, 8.6), and that of a 304 would be the file's.
    if (plain.status != 204 && plain.status != 304) response.prepare_payload();
    return response;
}

/// The answer, before the connection is closed, to a request whose end is not plain: a proxy before
/// scipd may take for a body what scipd takes for the next request. The parser refuses
/// Transfer-Encoding: chunked beside Content-Length by itself.
std::optional<HttpResponse> framing_fault(const http::request_header<>& request) {
    constexpr auto name = http::field::transfer_encoding;
    const auto encodings = request.count(name);
    if (encodings == 0) return std::nullopt;
    if (encodings == 1 && boost::beast::iequals(request[name], "chunked") &&
        request.version() >= 11) {
        return std::nullopt;
    }
    return problem(501, "Transfer-Encoding must be chunked and nothing else, in HTTP/1.1",
                   "Transfer-Encoding");
}

/// Makes of `http://HOST/PATH`, as proxies are sent it and every server must take it (RFC 9112,
/// 3.2.2), the target /PATH, and of Host that HOST, which is right where they differ. Leaves what
/// has no Host, or two.
void to_origin_form(http::request_header<>& request) {
    const std::string scheme = "http://";
    const std::string target(request.target());
    const bool is_absolute = boost::beast::iequals(target.substr(0, scheme.size()), scheme);
    if (!is_absolute || request.count(http::field::host) != 1) return;
    const auto end = std::min(target.find_first_of("/?", scheme.size()), target.size());
    request.set(http::field::host, target.substr(scheme.size(), end - scheme.size()));
    const std::string rest = target.substr(end);
    request.target(rest.starts_with('/') ? rest : "/" + rest);
}

using boost::system::error_code;

/// How long a client may take to read a refusal.
constexpr std::chrono::seconds linger{2};

/// How often to look whether a client that waits has hung up.
constexpr std::chrono::milliseconds glance_period{100};

/// Read at once.
constexpr std::size_t gulp = 4096;

/// What to tell a client whose request cannot be read, or nothing where it is gone.
std::optional<HttpResponse> unreadable(const error_code& error, Limits& limits,
                                       const HttpDoor& door) {
    if (error == http::error::body_limit) {
        return problem(413, limits.refuse(Limit::http_body_bytes, door.name));
    }
    if (error == http::error::header_limit) {
        return problem(431, limits.refuse(Limit::http_header_bytes, door.name));
    }
    if (error.category() == make_error_code(http::error::bad_method).category()) {
        return problem(400, "not HTTP/1.1: " + error.message());
    }
    return {};
}

/// What has come with the request is lost to the WebSocket, which would take the rest for frames.
HttpResponse early_frame() {
    return problem(400, "a client must wait for the answer before its first frame (RFC 6455, 4.1)");
}

}  // namespace

bool Presence::has_gone(int socket) {
    constexpr std::string_view interim = "HTTP/1.1 102 Processing\r\n\r\n";
    pollfd state{socket, POLLRDHUP, 0};  // errors and both ends closed are told in any case
    if (::poll(&state, 1, 0) != 1) return false;
    if ((state.revents & (POLLERR | POLLHUP)) != 0) return true;
    if (std::exchange(may_ask_, false))
        ::send(socket, interim.data(), interim.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    return false;
}

HttpConnection::HttpConnection(Protocol::socket socket, Address here,
                               std::shared_ptr<HttpService> service, SharedDoor door)
    : service_(std::move(service)),
      door_(std::move(door)),
      here_(std::move(here)),
      stream_(std::move(socket)),
      glance_(stream_.get_executor()) {
    service_->clients.insert(this);
}

HttpConnection::~HttpConnection() {
    service_->clients.erase(this);
}

void HttpConnection::read_header() {
    parser_.emplace();
    with_body_ = true;
    const Limits& limits = *service_->limits;
    // Its own limit is not exact: it is of what the parser gets at once.
    parser_->header_limit(std::numeric_limits<std::uint32_t>::max());
    parser_->body_limit(limits[Limit::http_body_bytes]);
    room_ = most_of_header();
    patience_ = service_->idle;
    pace_.begin(patience_);
    stream_.expires_at(pace_.end());
    parse();
}

void HttpConnection::read_more() {
    stream_.expires_at(pace_.end());
    stream_.async_read_some(buffer_.prepare(gulp),
                            [self = shared_from_this()](const Error& error, std::size_t bytes) {
                                if (error) return self->refuse(error);
                                if (self->parser_->is_header_done()) self->pace_.pass(bytes);
                                self->buffer_.commit(bytes);
                                self->parse();
                            });
}

/// Takes of the header or of the body what has come. A header has room in all. Of a body only the
/// line before a chunk, and all that follows the last chunk, need room: they stay in the buffer
/// until they are whole.
void HttpConnection::parse() {
    const bool in_body = parser_->is_header_done();
    const auto is_done = [&] { return in_body ? parser_->is_done() : parser_->is_header_done(); };
    while (!is_done()) {
        if (!in_body && room_ == most_of_header()) skip_empty_lines();
        const std::size_t size = buffer_.size();
        if (size == 0) return read_more();
        Error error;
        const std::size_t used = parser_->put(asio::buffer(buffer_.cdata(), room_), error);
        buffer_.consume(used);
        const bool is_full = size >= room_;
        if (!in_body) room_ -= used;
        if (error == http::error::need_more && !is_full) return read_more();
        if (error == http::error::need_more) error = http::error::header_limit;
        if (error) return refuse(error);
    }
    in_body ? answer() : come_in();
}

/// In front of a request some clients send one, which belongs to the body before (RFC 9112, 2.2).
void HttpConnection::skip_empty_lines() {
    const std::string_view come{static_cast<const char*>(buffer_.cdata().data()), buffer_.size()};
    buffer_.consume(std::min(come.find_first_not_of("\r\n"), come.size()));
}

void HttpConnection::turn_away(HttpResponse why) {
    patience_ = linger;
    write(std::move(why), false);
}

void HttpConnection::come_in() {
    if (service_->closed) return;
    to_origin_form(parser_->get());
    const auto& request = parser_->get();
    with_body_ = request.method() != http::verb::head;
    // What follows a body in chunks would count, too.
    wants_web_socket_ = boost::beast::websocket::is_upgrade(request);
    if (auto fault = framing_fault(request)) return write(std::move(*fault), false);
    if (!door_->gate) return allow_body();
    const bool has_body = !parser_->is_done();
    auto answer = door_->gate->answer(request, has_body, here_);
    if (!answer) return allow_body();
    // A body that nobody reads cannot be told from the next request.
    write(std::move(*answer), request.keep_alive() && !has_body);
}

/// A client that asks before it sends a large body waits for the answer.
void HttpConnection::allow_body() {
    if (parser_->is_done() ||
        !boost::beast::iequals(parser_->get()[http::field::expect], "100-continue")) {
        return read_body();
    }
    go_on_ = {http::status::continue_, 11};
    http::async_write(stream_, go_on_,
                      [self = shared_from_this()](const Error& error, std::size_t) {
                          if (!error) self->read_body();
                      });
}

void HttpConnection::read_body() {
    room_ = most_of_header();
    pace_.begin(patience_);
    parse();
}

void HttpConnection::answer() {
    if (service_->closed) return;
    const auto& request = parser_->get();
    if (wants_web_socket_) return upgrade();
    const bool keep_alive = request.keep_alive();
    const auto respond = [self = shared_from_this(), keep_alive](HttpResponse response) {
        if (!self->service_->closed) self->write(std::move(response), keep_alive);
    };
    answered_ = false;
    hung_up_ = {};
    presence_ = Presence{request.version() >= 11};
    HttpRequest plain = to_plain(request, rate_);
    plain.withdrawn = hung_up_.get_token();
    try {
        service_->handler(plain, respond);
    } catch (const std::exception& error) {
        respond(problem(500, error.what()));
    }
    if (!answered_) watch();
}

/// It does not read to find out: what a client has sent meanwhile would hide that it has hung up.
void HttpConnection::watch() {
    glance_.expires_after(glance_period);
    glance_.async_wait([weak = weak_from_this()](const Error& error) {
        const auto self = weak.lock();
        if (error || !self || self->answered_ || self->service_->closed) return;
        if (!self->presence_.has_gone(self->stream_.socket().native_handle())) return self->watch();
        self->hung_up_.request_stop();
    });
}

void HttpConnection::upgrade() {
    const auto& request = parser_->get();
    auto answer = service_->open_web_socket(to_plain(request, rate_));
    if (auto* refusal = std::get_if<HttpResponse>(&answer)) {
        return write(std::move(*refusal), request.keep_alive());
    }
    if (buffer_.size() != 0) return write(early_frame(), false);
    std::make_shared<WebSocketConnection>(std::move(stream_), service_, door_)
        ->open(request, std::get<Converse>(std::move(answer)));
}

void HttpConnection::refuse(const Error& error) {
    if (service_->closed) return;
    if (auto refusal = unreadable(error, *service_->limits, *door_))
        write(std::move(*refusal), false);
}

void HttpConnection::write(HttpResponse plain, bool keep_alive) {
    answered_ = true;
    glance_.cancel();
    response_ = to_beast(std::move(plain), keep_alive);
    if (!with_body_) response_.body().clear();
    serializer_.emplace(response_);
    pace_.begin(patience_);
    write_more(keep_alive);
}

void HttpConnection::write_more(bool keep_alive) {
    stream_.expires_at(pace_.end());
    http::async_write_some(
        stream_, *serializer_,
        [self = shared_from_this(), keep_alive](const Error& error, std::size_t bytes) {
            if (error || self->service_->closed) return;
            self->pace_.pass(bytes);
            if (!self->serializer_->is_done()) return self->write_more(keep_alive);
            keep_alive ? self->read_header() : self->close_gently();
        });
}

/// Reads until the client ends: a client that still sends would lose our answer to a reset
/// connection.
void HttpConnection::close_gently() {
    Error error;
    stream_.socket().shutdown(asio::socket_base::shutdown_send, error);
    if (error) return;
    stream_.expires_after(linger);
    drop_input();
}

void HttpConnection::drop_input() {
    buffer_.clear();
    stream_.async_read_some(buffer_.prepare(gulp),
                            [self = shared_from_this()](const Error& error, std::size_t) {
                                if (!error) self->drop_input();
                            });
}

}  // namespace scipd::daemon
