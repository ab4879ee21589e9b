// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Any bytes from a client to the HTTP server, through a gate that asks for a token; or, as the
// first byte says, to a WebSocket that is open already. The byte also says how large the pieces are
// in which they come. However they are cut, the server sends the same: whole responses, or whole
// frames. Nobody is heard who does not say the token, the Host and, with a body, its type. When the
// client has ended, the server has, too.
#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/local/connect_pair.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <sys/socket.h>

#include "daemon/http/http_connection.h"
#include "daemon/http/http_service.h"
#include "daemon/http/problem.h"

namespace {

using namespace scipd::daemon;
namespace asio = boost::asio;
using Local = asio::local::stream_protocol;

constexpr std::string_view token = "a+token/";
/// A Unix socket is nowhere, so this is what its clients have connected to.
constexpr std::string_view host = ":0";

void require(bool holds, const char* what) {
    if (holds) return;
    std::cerr << "does not hold: " << what << '\n';
    std::abort();
}

bool has(std::string_view text, std::string_view part) {
    return text.find(part) != text.npos;
}

std::string lower(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

/// With a sign for each %XX, wherever that stands.
std::string unescaped(std::string_view text) {
    std::string plain;
    while (!text.empty()) {
        const bool escape = text.size() > 2 && text[0] == '%' &&
                            std::isxdigit(static_cast<unsigned char>(text[1])) != 0 &&
                            std::isxdigit(static_cast<unsigned char>(text[2])) != 0;
        plain += escape ? static_cast<char>(std::stoi(std::string(text.substr(1, 2)), nullptr, 16))
                        : text[0];
        text.remove_prefix(escape ? 3 : 1);
    }
    return plain;
}

/// Says each message again.
class Echo : public Conversation {
  public:
    explicit Echo(WebSocket& socket) : socket_(socket) {}

    std::size_t take(std::string_view rest) override {
        socket_.send(std::make_shared<const std::string>(rest));
        return rest.size();
    }

  private:
    WebSocket& socket_;
};

SharedLimits tight_limits() {
    LimitValues values;
    values[Limit::http_header_bytes] = 600;
    values[Limit::http_body_bytes] = 900;
    values[Limit::websocket_messages_per_s] = 1'000'000;
    return std::make_shared<Limits>(values);
}

constexpr std::string_view upgrade =
    "GET /echo HTTP/1.1\r\nHost: :0\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
    "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
    "Sec-WebSocket-Protocol: scipd, bearer.a%2Btoken%2F\r\n\r\n";

/// A server with one client, which sends these bytes in pieces and then ends.
class Exchange {
  public:
    Exchange(std::string_view bytes, bool by_web_socket) : bytes_(bytes) {
        service_->handler = [this](const HttpRequest& request, const Respond& respond) {
            require_let_in(request);
            respond({.content_type = "text/plain",
                     .body = request.method + ' ' + request.path + '?' + request.query + ' ' +
                             std::to_string(request.body.size())});
        };
        service_->open_web_socket =
            [=, this](const HttpRequest& request) -> std::variant<HttpResponse, Converse> {
            if (by_web_socket)
                return Converse([](WebSocket& socket) { return std::make_unique<Echo>(socket); });
            require_let_in(request);
            return problem(404, "there are none");
        };
        service_->limits = tight_limits();
        Local::socket server(context_);
        asio::local::connect_pair(server, client_);
        const auto is_public = [](std::string_view path) { return path == "/public"; };
        const auto door = std::make_shared<const HttpDoor>(
            HttpDoor{"fuzz", Limit::http_connections, Gate{std::string(token), is_public}});
        std::make_shared<HttpConnection>(std::move(server), Address{}, service_, door)
            ->read_header();
        if (by_web_socket) {
            send(upgrade);
            require(come_.starts_with("HTTP/1.1 101 ") && come_.ends_with("\r\n\r\n"),
                    "it is open");
            come_.clear();
        }
    }

    /// Returns all that the server has sent.
    std::string in_pieces_of(std::size_t size) {
        for (std::string_view rest = bytes_; !rest.empty();
             rest.remove_prefix(std::min(size, rest.size())))
            send(rest.substr(0, size));
        ::shutdown(client_.native_handle(), SHUT_WR);
        listen();
        require(service_->clients.empty(), "the server ends with its client");
        require(heard_ <= count_of("HTTP/1.1 ", come_), "each request has its response");
        return come_;
    }

  private:
    static std::size_t count_of(std::string_view part, std::string_view text) {
        std::size_t count = 0;
        for (auto at = text.find(part); at != text.npos; at = text.find(part, at + part.size()))
            ++count;
        return count;
    }

    void send(std::string_view piece) {
        // A server that has ended takes no more.
        (void)::send(client_.native_handle(), piece.data(), piece.size(), MSG_NOSIGNAL);
        listen();
    }

    void listen() {
        context_.restart();
        context_.poll();
        char buffer[4096];
        for (;;) {
            const auto got = ::recv(client_.native_handle(), buffer, sizeof buffer, MSG_DONTWAIT);
            if (got <= 0) return;
            come_.append(buffer, static_cast<std::size_t>(got));
            context_.poll();
        }
    }

    void require_let_in(const HttpRequest& request) {
        ++heard_;
        const bool is_public = request.path == "/public" && request.method == "GET";
        require(is_public || has(bytes_, token) || has(unescaped(bytes_), token), "the token");
        require(has(bytes_, host), "the Host");
        require(request.body.empty() || has(lower(std::string(bytes_)), "application/json"),
                "the type of a body");
        require(request.body.size() <= 900, "the limit of a body");
    }

    std::string_view bytes_;
    asio::io_context context_;
    const std::shared_ptr<HttpService> service_ = std::make_shared<HttpService>();
    Local::socket client_{context_};
    std::string come_;
    std::size_t heard_ = 0;
};

/// Takes a line off the front of a header.
std::string_view taken_line(std::string_view& text) {
    const auto end = text.find("\r\n");
    require(end != text.npos, "a line of a header ends");
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end + 2);
    return line;
}

/// A frame of a server (RFC 6455, 5.2).
void take_frame(std::string_view& text) {
    const auto byte = [&](std::size_t i) {
        require(i < text.size(), "a frame is whole");
        return static_cast<unsigned char>(text[i]);
    };
    constexpr std::string_view known{"\x0\x1\x2\x8\x9\xA", 6};
    require((byte(0) & 0x70) == 0, "a frame has no extensions");
    require(has(known, {std::string(1, static_cast<char>(byte(0) & 0x0F))}), "a frame of a kind");
    require(byte(1) < 0x80, "a server masks nothing");
    std::size_t head = 2;
    std::size_t length = byte(1);
    if (length == 126) {
        length = byte(2) * 256U + byte(3);
        head = 4;
    }
    require(length != 127 && head + length <= text.size(), "a frame is whole and short");
    text.remove_prefix(head + length);
}

void take_response(std::string_view& text) {
    const std::string_view status = taken_line(text);
    require(status.starts_with("HTTP/1.1 ") && status.size() >= 12, "a status line");
    const std::string_view code = status.substr(9, 3);
    std::size_t length = 0;
    for (auto line = taken_line(text); !line.empty(); line = taken_line(text)) {
        require(has(line, ":"), "a field has a name");
        constexpr std::string_view name = "Content-Length: ";
        if (line.starts_with(name)) length = std::stoul(std::string(line.substr(name.size())));
    }
    if (code == "100" || code == "204") return;
    // HEAD has no body, and no body begins so.
    if (text.empty() || text.starts_with("HTTP/1.1 ")) return;
    require(length <= text.size(), "a body is whole");
    text.remove_prefix(length);
}

/// Without the refusal of a header that cannot be read. It is due once the header ends; whether the
/// parser finds the fault earlier depends on the pieces, as when the client ends before the header.
std::string_view readable(std::string_view sent) {
    std::string_view last;
    for (std::string_view rest = sent; !rest.empty();) {
        last = rest;
        take_response(rest);
    }
    const bool refused = has(last, "not HTTP/1.1: ") || has(last, "http_header_bytes");
    return sent.substr(0, sent.size() - (refused ? last.size() : 0));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::size_t most = 1 << 14;  // which the kernel keeps
    if (size == 0 || size > most) return 0;
    const bool by_web_socket = (data[0] & 0x80U) != 0;
    const std::size_t piece = 1 + (data[0] & 0x7FU);
    const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
    const std::string sent = Exchange(bytes, by_web_socket).in_pieces_of(most);
    const std::string again = Exchange(bytes, by_web_socket).in_pieces_of(piece);
    if (by_web_socket) {
        for (std::string_view rest = sent; !rest.empty();)
            take_frame(rest);
        require(again == sent, "pieces change no frame");
    } else {
        require(readable(again) == readable(sent), "pieces change no response");
    }
    return 0;
}
