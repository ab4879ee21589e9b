// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Who may come in by TCP: by the gate's own answers, and by a server that real sockets speak to.
#include "daemon/http/http_gate.h"

#include <future>
#include <optional>
#include <string>
#include <thread>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/http/verb.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/http/http_server.h"
#include "tests/support/temp_dir.h"

namespace scipd::daemon {
namespace {

namespace asio = boost::asio;
namespace http = boost::beast::http;
using asio::ip::tcp;
using testing::HasSubstr;
using testing::StartsWith;

const Address loopback{"127.0.0.1", 8080};
const Address in_the_lab{"192.168.7.3", 8080};

Gate::Header asked_of(const std::string& host) {
    Gate::Header request;
    request.method(http::verb::put);
    request.set(http::field::host, host);
    return request;
}

Gate::Header from_page(const std::string& origin) {
    auto request = asked_of("localhost:8080");
    request.set(http::field::origin, origin);
    return request;
}

/// The status of the refusal; 200: the request may come in.
int status(const Gate::Header& request, bool has_body = false, const Address& here = loopback) {
    const auto answer = Gate{}.answer(request, has_body, here);
    return answer ? answer->status : 200;
}

TEST(Gate, OpensToTheNamesOfItsAddress) {
    for (const char* host : {"127.0.0.1:8080", "localhost:8080", "LocalHost:8080", "[::1]:8080"}) {
        EXPECT_EQ(status(asked_of(host)), 200) << host;
        EXPECT_EQ(status(asked_of(host), false, {"::1", 8080}), 200) << host;
    }
    EXPECT_EQ(status(asked_of("192.168.7.3:8080"), false, in_the_lab), 200);
    EXPECT_EQ(status(asked_of("127.0.0.2:8080"), false, {"127.0.0.2", 8080}), 200);
    EXPECT_EQ(status(asked_of("localhost"), false, {"127.0.0.1", 80}), 200);
    EXPECT_EQ(status(asked_of("[::1]"), false, {"127.0.0.1", 80}), 200);
}

TEST(Gate, RefusesNamesThatAnybodyMayHaveMadeToMeanTheAddress) {
    for (const char* host : {"evil.example", "evil.example:8080", "127.0.0.1", "localhost:8081",
                             "127.0.0.1:8080.evil.example", "evil.example:8080@127.0.0.1:8080", "",
                             "192.168.7.3:8080"}) {
        EXPECT_EQ(status(asked_of(host)), 403) << host;
    }
    EXPECT_EQ(status(asked_of("localhost:8080"), false, in_the_lab), 403);
    EXPECT_EQ(status(Gate::Header{}), 403) << "no Host at all";
    auto two = asked_of("127.0.0.1:8080");
    two.insert(http::field::host, "evil.example");
    EXPECT_EQ(status(two), 403);
}

TEST(Gate, OpensToItsOwnPagesAlone) {
    for (const char* origin :
         {"http://127.0.0.1:8080", "http://localhost:8080", "http://[::1]:8080"})
        EXPECT_EQ(status(from_page(origin)), 200) << origin;
    for (const char* origin :
         {"http://evil.example", "https://localhost:8080", "http://localhost:8081", "null", "",
          "http://localhost:8080.evil.example", "localhost:8080", "file://"}) {
        EXPECT_EQ(status(from_page(origin)), 403) << origin;
    }
    auto two = from_page("http://localhost:8080");
    two.insert(http::field::origin, "http://evil.example");
    EXPECT_EQ(status(two), 403);
}

TEST(Gate, AnswersThePreflightOfItsOwnPagesAlone) {
    auto own = from_page("http://localhost:8080");
    own.method(http::verb::options);
    own.set(http::field::access_control_request_method, "PUT");
    const auto answer = Gate{}.answer(own, false, loopback);
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->status, 204);
    EXPECT_THAT(answer->headers,
                testing::Contains(testing::Pair(std::string("Access-Control-Allow-Origin"),
                                                std::string("http://localhost:8080"))));
    auto foreign = own;
    foreign.set(http::field::origin, "http://evil.example");
    const auto refusal = Gate{}.answer(foreign, false, loopback);
    ASSERT_TRUE(refusal);
    EXPECT_EQ(refusal->status, 403);
    EXPECT_THAT(refusal->headers, testing::IsEmpty());
}

// What pages of others can send without a preflight is none of these.
TEST(Gate, LetsBodiesInThatAreJson) {
    auto request = asked_of("localhost:8080");
    EXPECT_EQ(status(request), 200);
    EXPECT_EQ(status(request, true), 415);
    for (const char* type : {"text/plain", "application/x-www-form-urlencoded", "application/jsonp",
                             "text/plain;application/json", "multipart/form-data"}) {
        request.set(http::field::content_type, type);
        EXPECT_EQ(status(request, true), 415) << type;
    }
    for (const char* type :
         {"application/json", "Application/JSON", "application/json; charset=utf-8"}) {
        request.set(http::field::content_type, type);
        EXPECT_EQ(status(request, true), 200) << type;
    }
    request.insert(http::field::content_type, "text/plain");
    EXPECT_EQ(status(request, true), 415) << "it says two";
}

TEST(Gate, AsksForTheToken) {
    const Gate gate{"correct-horse-battery"};
    auto request = asked_of("localhost:8080");
    const auto status = [&] {
        const auto answer = gate.answer(request, false, loopback);
        return answer ? answer->status : 200;
    };
    const auto refusal = gate.answer(request, false, loopback);
    ASSERT_TRUE(refusal);
    EXPECT_EQ(refusal->status, 401);
    EXPECT_THAT(refusal->headers,
                testing::ElementsAre(testing::Pair("WWW-Authenticate", "Bearer")));
    for (const char* said :
         {"", "Bearer", "Bearer ", "Bearer correct-horse-batterx", "Bearer correct-horse-batter",
          "Bearer correct-horse-battery2", "Bearer correct-horse-batterycorrect-horse-battery",
          "Basic correct-horse-battery", "correct-horse-battery"}) {
        request.set(http::field::authorization, said);
        EXPECT_EQ(status(), 401) << said;
    }
    request.set(http::field::authorization, "bearer correct-horse-battery");
    EXPECT_EQ(status(), 200);
    request.set(http::field::origin, "http://evil.example");
    EXPECT_EQ(status(), 403);
}

// No page in a browser can set the Authorization of a WebSocket.
TEST(Gate, TakesTheTokenAsASubprotocol) {
    const Gate gate{"correct-horse-battery"};
    const auto status = [&](const char* offers, const char* authorization = nullptr) {
        auto request = asked_of("localhost:8080");
        request.set(http::field::sec_websocket_protocol, offers);
        if (authorization != nullptr) request.set(http::field::authorization, authorization);
        const auto answer = gate.answer(request, false, loopback);
        return answer ? answer->status : 200;
    };
    EXPECT_EQ(status("scipd, bearer.correct-horse-battery"), 200);
    EXPECT_EQ(status("bearer.correct-horse-battery,scipd"), 200);
    for (const char* offers :
         {"", "scipd", "correct-horse-battery", "scipd, bearer.", "scipd, bearer.correct-horse",
          "scipd, Bearer correct-horse-battery", "bearer.x, bearer.correct-horse-battery"})
        EXPECT_EQ(status(offers), 401) << offers;
    EXPECT_EQ(status("bearer.correct-horse-battery", "Bearer other"), 401) << "which of the two?";
}

TEST(Gate, TakesAllSubprotocolsThatAreOfferedForOneList) {
    auto request = asked_of("localhost:8080");
    request.insert(http::field::sec_websocket_protocol, "\tother ,scipd\t");
    request.insert(http::field::sec_websocket_protocol, "bearer.correct");
    EXPECT_EQ(subprotocols(request),
              (std::vector<std::string_view>{"other", "scipd", "bearer.correct"}));
    EXPECT_FALSE(Gate{"correct"}.answer(request, false, loopback));
    request.insert(http::field::sec_websocket_protocol, "bearer.wrong");
    EXPECT_EQ(Gate{"correct"}.answer(request, false, loopback)->status, 401) << "which of the two?";
}

// The token is one that `openssl rand -base64` makes, say.
TEST(Gate, TakesATokenAsBrowsersMustWriteIt) {
    const auto status = [&](const char* token, const char* offer) {
        auto request = asked_of("localhost:8080");
        request.set(http::field::sec_websocket_protocol, offer);
        const auto answer = Gate{token}.answer(request, false, loopback);
        return answer ? answer->status : 200;
    };
    EXPECT_EQ(status("aZ+/==,(x)", "scipd, bearer.aZ%2B%2F%3D%3D%2C%28x%29"), 200);
    EXPECT_EQ(status("aZ+/==", "scipd, bearer.aZ+/=="), 200) << "programs may";
    EXPECT_EQ(status("50%41", "scipd, bearer.50%41"), 200);
    EXPECT_EQ(status("50%41", "scipd, bearer.50%2541"), 200);
    EXPECT_EQ(status("50%41", "scipd, bearer.50A"), 401);
    EXPECT_EQ(status("correct-horse", "scipd, bearer.%zz"), 401);
}

TEST(Gate, ShowsWhatIsPublicToAllWhoMayConnect) {
    const Gate gate{"secret", [](std::string_view path) { return path == "/"; }};
    const auto status = [&](http::verb method, const char* target, const char* host) {
        auto request = asked_of(host);
        request.method(method);
        request.target(target);
        const auto answer = gate.answer(request, false, loopback);
        return answer ? answer->status : 200;
    };
    EXPECT_EQ(status(http::verb::get, "/", "localhost:8080"), 200);
    EXPECT_EQ(status(http::verb::head, "/?x=1", "localhost:8080"), 200);
    EXPECT_EQ(status(http::verb::put, "/", "localhost:8080"), 401);
    EXPECT_EQ(status(http::verb::get, "/status", "localhost:8080"), 401);
    EXPECT_EQ(status(http::verb::get, "/", "evil.example"), 403);
}

/// A server that answers everything with "heard", and WebSockets with a 404 that says the same.
class GateOfAServer : public testing::Test {
  protected:
    GateOfAServer() {
        std::promise<void> listening;
        asio::post(io_, [&] {
            const auto heard = [](const HttpRequest&) {
                return HttpResponse{.status = 404, .content_type = "text/plain", .body = "heard"};
            };
            server_.emplace(
                io_.get_executor(),
                [heard](const HttpRequest& request, const Respond& respond) {
                    respond(heard(request));
                },
                heard);
            port_ = server_->listen(Address{"127.0.0.1", 0}).port;
            server_->listen(socket_path_);
            listening.set_value();
        });
        thread_ = std::thread{[this] { io_.run(); }};
        listening.get_future().wait();
    }
    ~GateOfAServer() override {
        asio::post(io_, [this] { server_.reset(); });
        thread_.join();
    }

    template <class Protocol>
    std::string ask(const typename Protocol::endpoint& where, const std::string& bytes) {
        asio::io_context io;
        typename Protocol::socket socket{io};
        socket.connect(where);
        asio::write(socket, asio::buffer(bytes));
        std::string text;
        boost::system::error_code end;
        asio::read(socket, asio::dynamic_buffer(text), end);
        return text;
    }
    std::string ask_tcp(const std::string& bytes) {
        return ask<tcp>({asio::ip::make_address("127.0.0.1"), port_}, bytes);
    }
    [[nodiscard]] std::string own() const { return "127.0.0.1:" + std::to_string(port_); }

    tests::TempDir dir_;
    std::filesystem::path socket_path_ = dir_.path() / "control.sock";
    std::uint16_t port_ = 0;
    asio::io_context io_{1};
    std::optional<HttpServer> server_;
    std::thread thread_;
};

const std::string end = "Connection: close\r\n\r\n";
const std::string upgrade =
    "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
    "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";

TEST_F(GateOfAServer, KeepsTheWebOut) {
    EXPECT_THAT(ask_tcp("GET / HTTP/1.1\r\nHost: " + own() + "\r\n" + end), HasSubstr("heard"));
    const auto rebound = ask_tcp("GET / HTTP/1.1\r\nHost: evil.example\r\n" + end);
    EXPECT_THAT(rebound, StartsWith("HTTP/1.1 403 Forbidden\r\n"));
    EXPECT_THAT(rebound, HasSubstr(R"("field":"Host")"));
    EXPECT_THAT(rebound, testing::Not(HasSubstr("heard")));
    const auto foreign =
        ask_tcp("GET / HTTP/1.1\r\nHost: " + own() + "\r\nOrigin: http://evil.example\r\n" + end);
    EXPECT_THAT(foreign, StartsWith("HTTP/1.1 403 "));
    EXPECT_THAT(foreign, HasSubstr(R"("field":"Origin")"));
}

TEST_F(GateOfAServer, KeepsForeignWebSocketsOut) {
    const std::string to_us = "GET / HTTP/1.1\r\nHost: " + own() + "\r\n" + upgrade;
    const std::string close = "\r\nGET / HTTP/1.1\r\n\r\n" + end;
    EXPECT_THAT(ask_tcp(to_us + "Origin: http://" + own() + "\r\n" + close), HasSubstr("heard"));
    const auto foreign = ask_tcp(to_us + "Origin: http://evil.example\r\n" + close);
    EXPECT_THAT(foreign, StartsWith("HTTP/1.1 403 "));
    EXPECT_THAT(foreign, testing::Not(HasSubstr("heard")));
}

// It does not read the body, and so cannot take a part of it for another request.
TEST_F(GateOfAServer, NeverTakesABodyItRefusesForARequest) {
    const std::string hidden = "GET / HTTP/1.1\r\nHost: " + own() + "\r\n" + end;
    const auto text =
        ask_tcp("POST / HTTP/1.1\r\nHost: " + own() +
                "\r\nContent-Type: text/plain\r\nContent-Length: " + std::to_string(hidden.size()) +
                "\r\n\r\n" + hidden);
    EXPECT_THAT(text, StartsWith("HTTP/1.1 415 Unsupported Media Type\r\n"));
    EXPECT_THAT(text, testing::Not(HasSubstr("heard")));
}

TEST_F(GateOfAServer, IsNotThereOnTheUnixSocket) {
    const auto text = ask<asio::local::stream_protocol>(
        socket_path_.string(),
        "PUT / HTTP/1.1\r\nHost: anything\r\nOrigin: http://evil.example\r\n"
        "Content-Type: application/x-www-form-urlencoded\r\nContent-Length: 2\r\n" +
            end + "{}");
    EXPECT_THAT(text, HasSubstr("heard"));
}

}  // namespace
}  // namespace scipd::daemon
