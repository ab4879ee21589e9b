// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/control/http_server.h"

#include <exception>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <boost/asio/awaitable.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/beast/core/basic_stream.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http.hpp>
#include <sys/stat.h>

#include "daemon/control/problem.h"

namespace scipd::daemon {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace fs = std::filesystem;
namespace http = boost::beast::http;

using boost::system::error_code;

struct HttpServer::State {
    Handler handler;
    HttpLimits limits;
    bool closed = false;
    std::vector<std::function<void()>> close_acceptors;
    std::map<const void*, std::function<void()>> close_connections;

    HttpResponse answer(const HttpRequest& request) {
        try {
            return handler(request);
        } catch (const std::exception& error) {
            return problem(500, error.what());
        }
    }
};

namespace {

using Request = http::request<http::string_body>;
using Response = http::response<http::string_body>;

/// How long a client may take to read what it was refused with.
constexpr std::chrono::seconds linger{2};
/// After a failed accept, as when all descriptors are taken: not at once again.
constexpr std::chrono::milliseconds accept_pause{100};

HttpRequest to_plain(const Request& request) {
    const std::string target{request.target().data(), request.target().size()};
    const auto mark = target.find('?');
    // HEAD is GET without the body of the answer.
    const bool is_head = request.method() == http::verb::head;
    const std::string method{request.method_string().data(), request.method_string().size()};
    return {.method = is_head ? "GET" : method,
            .path = target.substr(0, mark),
            .query = mark == target.npos ? "" : target.substr(mark + 1),
            .body = request.body()};
}

Response to_beast(const HttpResponse& plain, bool keep_alive) {
    Response response;
    response.version(11);
    response.result(static_cast<unsigned>(plain.status));
    if (!plain.content_type.empty()) response.set(http::field::content_type, plain.content_type);
    if (!plain.allow.empty()) response.set(http::field::allow, plain.allow);
    response.body() = plain.body;
    response.keep_alive(keep_alive);
    // A 204 has no length, not even 0 (RFC 9110, 8.6).
    if (plain.status != 204) response.prepare_payload();
    return response;
}

/// What to tell a client whose request cannot be read, or nothing where it is gone.
std::optional<HttpResponse> unreadable(const error_code& error, const HttpLimits& limits) {
    if (error == http::error::end_of_stream || error == http::error::partial_message) return {};
    if (error == http::error::body_limit) {
        return problem(413,
                       "the body is larger than " + std::to_string(limits.body_bytes) + " bytes");
    }
    if (error == http::error::header_limit || error == http::error::buffer_overflow) {
        return problem(
            431, "the header is larger than " + std::to_string(limits.header_bytes) + " bytes");
    }
    if (error.category() == make_error_code(http::error::bad_method).category()) {
        return problem(400, "not HTTP/1.1: " + error.message());
    }
    return {};
}

/// A client that asks before it sends a large body waits for this.
template <class Stream>
asio::awaitable<void> allow_body(Stream& stream, const Request& request) {
    if (request[http::field::expect] != "100-continue") co_return;
    http::response<http::empty_body> go_on{http::status::continue_, 11};
    error_code error;
    co_await http::async_write(stream, go_on, asio::redirect_error(asio::use_awaitable, error));
}

/// A client that still sends would lose our answer to a reset connection: read until it ends.
template <class Stream>
asio::awaitable<void> close_gently(Stream& stream) {
    error_code error;
    stream.socket().shutdown(asio::socket_base::shutdown_send, error);
    stream.expires_after(linger);
    std::string dropped(4096, '\0');
    while (!error) {
        co_await stream.async_read_some(asio::buffer(dropped),
                                        asio::redirect_error(asio::use_awaitable, error));
    }
}

/// One request and its response. False: no more of them.
template <class Stream, class State>
asio::awaitable<bool> exchange(Stream& stream, beast::flat_buffer& buffer, State& state) {
    http::request_parser<http::string_body> parser;
    parser.header_limit(state.limits.header_bytes);
    parser.body_limit(state.limits.body_bytes);
    stream.expires_after(state.limits.idle);
    error_code error;
    co_await http::async_read_header(stream, buffer, parser,
                                     asio::redirect_error(asio::use_awaitable, error));
    if (!error && !parser.is_done()) {
        co_await allow_body(stream, parser.get());
        co_await http::async_read(stream, buffer, parser,
                                  asio::redirect_error(asio::use_awaitable, error));
    }
    if (state.closed) co_return false;
    const auto refusal = error ? unreadable(error, state.limits) : std::nullopt;
    if (error && !refusal) co_return false;

    const bool keep_alive = !refusal && parser.get().keep_alive();
    auto response = to_beast(refusal ? *refusal : state.answer(to_plain(parser.get())), keep_alive);
    if (parser.get().method() == http::verb::head) response.body().clear();
    co_await http::async_write(stream, response, asio::redirect_error(asio::use_awaitable, error));
    co_return keep_alive && !error;
}

template <class Socket, class State>
asio::awaitable<void> serve(Socket socket, std::shared_ptr<State> state) {
    beast::basic_stream<typename Socket::protocol_type> stream{std::move(socket)};
    state->close_connections.emplace(&stream, [&stream] { stream.close(); });
    // However the coroutine ends, be it with its io_context.
    const std::shared_ptr<void> gone{
        nullptr, [&stream, &state](void*) { state->close_connections.erase(&stream); }};
    beast::flat_buffer buffer;
    while (co_await exchange(stream, buffer, *state)) {
    }
    if (!state->closed) co_await close_gently(stream);
}

template <class Acceptor, class State>
asio::awaitable<void> accept_all(std::shared_ptr<Acceptor> acceptor, std::shared_ptr<State> state) {
    const auto executor = acceptor->get_executor();
    asio::steady_timer pause{executor};
    while (!state->closed) {
        error_code error;
        auto socket =
            co_await acceptor->async_accept(asio::redirect_error(asio::use_awaitable, error));
        if (state->closed) co_return;
        if (!error) {
            asio::co_spawn(executor, serve(std::move(socket), state), asio::detached);
            continue;
        }
        pause.expires_after(accept_pause);
        co_await pause.async_wait(asio::redirect_error(asio::use_awaitable, error));
    }
}

/// What a daemon that was killed has left behind.
void remove_stale(const fs::path& path, const asio::any_io_executor& executor) {
    using Local = asio::local::stream_protocol;
    const auto type = fs::symlink_status(path).type();
    if (type == fs::file_type::not_found) return;
    if (type != fs::file_type::socket) throw std::runtime_error("it is there and no socket");
    Local::socket probe{executor};
    error_code error;
    probe.connect(Local::endpoint{path.string()}, error);
    if (!error) throw std::runtime_error("another program listens there");
    if (error != asio::error::connection_refused) throw boost::system::system_error{error};
    fs::remove(path);
}

template <class Listen>
void name_failures(const std::string& where, Listen listen) {
    try {
        listen();
    } catch (const boost::system::system_error& error) {
        throw std::runtime_error("cannot listen on " + where + ": " + error.code().message());
    } catch (const std::exception& error) {
        throw std::runtime_error("cannot listen on " + where + ": " + error.what());
    }
}

}  // namespace

HttpServer::HttpServer(asio::any_io_executor executor, Handler handler, const HttpLimits& limits)
    : executor_(std::move(executor)), state_(std::make_shared<State>()) {
    state_->handler = std::move(handler);
    state_->limits = limits;
}

HttpServer::~HttpServer() {
    close();
}

template <class Acceptor>
void HttpServer::accept_from(Acceptor acceptor) {
    const auto shared = std::make_shared<Acceptor>(std::move(acceptor));
    state_->close_acceptors.emplace_back([shared] {
        error_code ignored;
        shared->close(ignored);
    });
    asio::co_spawn(executor_, accept_all(shared, state_), asio::detached);
}

void HttpServer::listen(const fs::path& socket) {
    using Local = asio::local::stream_protocol;
    name_failures(socket.string(), [&] {
        remove_stale(socket, executor_);
        Local::acceptor acceptor{executor_, Local{}};
        // On Linux the file inherits the mode of its descriptor: at no instant can others open it.
        ::fchmod(acceptor.native_handle(), S_IRUSR | S_IWUSR);
        acceptor.bind(Local::endpoint{socket.string()});
        sockets_.push_back(socket);
        acceptor.listen();
        accept_from(std::move(acceptor));
    });
}

Address HttpServer::listen(const Address& address) {
    using asio::ip::tcp;
    Address taken;
    name_failures(address.host + ":" + std::to_string(address.port), [&] {
        const tcp::endpoint wanted{asio::ip::make_address(address.host), address.port};
        tcp::acceptor acceptor{executor_, wanted};
        taken = {address.host, acceptor.local_endpoint().port()};
        accept_from(std::move(acceptor));
    });
    return taken;
}

void HttpServer::close() {
    state_->closed = true;
    for (const auto& close_acceptor : state_->close_acceptors)
        close_acceptor();
    for (const auto& [stream, close_connection] : state_->close_connections)
        close_connection();
    state_->close_acceptors.clear();
    for (const auto& socket : sockets_) {
        std::error_code ignored;
        fs::remove(socket, ignored);
    }
    sockets_.clear();
}

}  // namespace scipd::daemon
