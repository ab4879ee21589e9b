// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The HTTP server over real sockets, against clients that behave and clients that do not.
#include "daemon/http/http_server.h"

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <stdexcept>
#include <stop_token>
#include <thread>

#include <boost/asio/connect.hpp>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/write.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/support/temp_dir.h"

namespace scipd::daemon {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using Local = asio::local::stream_protocol;
using testing::HasSubstr;
using testing::StartsWith;

/// Who asked for /never.
struct Waiting {
    std::stop_token withdrawn;
    Respond respond;
};
std::vector<Waiting> waiting;

/// The size of what "/large" answers: more than the kernel keeps.
constexpr std::size_t large = 4'000'000;

/// Says what it was asked; "/throw" does.
void echo(const HttpRequest& request, const Respond& respond) {
    if (request.path == "/never") return waiting.push_back({request.withdrawn, respond});
    if (request.path == "/throw") throw std::runtime_error("a bug");
    HttpResponse response;
    response.content_type = "text/plain";
    response.body = request.method + " " + request.path + " [" + request.query + "] " +
                    std::to_string(request.body.size());
    if (request.path == "/large") response.body = std::string(large, 'x');
    if (request.path == "/allow") response.status = 405, response.allow = "GET, PUT";
    if (request.path == "/empty")
        response = {.status = 204, .content_type = {}, .body = {}, .allow = {}};
    respond(response);
}

/// Says over a WebSocket what it was told.
class Parrot : public Conversation {
  public:
    explicit Parrot(WebSocket& socket) : socket_(socket) {}
    std::size_t take(std::string_view message) override {
        socket_.send(std::make_shared<const std::string>(message));
        return message.size();
    }

  private:
    WebSocket& socket_;
};

/// Takes a byte at a time, and says when it has had enough.
class Nibbler : public Conversation {
  public:
    explicit Nibbler(WebSocket& socket) : socket_(socket) {}
    std::size_t take(std::string_view rest) override {
        if (rest.size() == 1) socket_.send(std::make_shared<const std::string>("all"));
        return 1;
    }

  private:
    WebSocket& socket_;
};

/// Sends more than the kernel keeps, and cuts the client when it is told something.
class Cutter : public Conversation {
  public:
    explicit Cutter(WebSocket& socket) : socket_(socket) {
        for (int i = 0; i < 3; ++i)
            socket.send(std::make_shared<const std::string>(large, 'x'));
    }
    std::size_t take(std::string_view rest) override {
        socket_.cut();
        return rest.size();
    }

  private:
    WebSocket& socket_;
};

/// Takes a while to begin.
class Sleeper : public Conversation {
  public:
    Sleeper() {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        awake = true;
    }
    std::size_t take(std::string_view rest) override { return rest.size(); }

    inline static std::atomic<bool> awake = false;
};

std::variant<HttpResponse, Converse> parrots(const HttpRequest& request) {
    const std::string path = request.path;
    return [path](WebSocket& socket) -> std::unique_ptr<Conversation> {
        if (path == "/nibble") return std::make_unique<Nibbler>(socket);
        if (path == "/cut") return std::make_unique<Cutter>(socket);
        if (path == "/sleep") return std::make_unique<Sleeper>();
        return std::make_unique<Parrot>(socket);
    };
}

/// A server on a thread of its own.
class HttpServerTest : public testing::Test {
  protected:
    ~HttpServerTest() override {
        on_server([this] { server_.reset(); });
        work_.reset();
        thread_.join();
    }

    /// What it throws comes back as its text.
    template <class Work>
    std::string on_server(Work work) {
        const auto failure = std::make_shared<std::promise<std::string>>();
        asio::post(io_, [failure, &work] {
            try {
                work();
                failure->set_value("");
            } catch (const std::runtime_error& error) {
                failure->set_value(error.what());
            }
        });
        return failure->get_future().get();
    }

    void start(const LimitValues& values = {}) {
        on_server([&] {
            limits_->set(values);
            server_.emplace(io_.get_executor(), echo, parrots, limits_);
            port_ = server_->listen(Address{"127.0.0.1", 0}).port;
            server_->listen(socket_path_);
        });
    }

    [[nodiscard]] tcp::socket connect() {
        tcp::socket socket{client_io_};
        socket.connect({asio::ip::make_address("127.0.0.1"), port_});
        return socket;
    }

    [[nodiscard]] Local::socket connect_local() {
        Local::socket socket{client_io_};
        socket.connect(Local::endpoint{socket_path_.string()});
        return socket;
    }

    /// All that comes until the server closes.
    template <class Socket>
    static std::string rest(Socket& socket) {
        std::string text;
        boost::system::error_code error;
        asio::read(socket, asio::dynamic_buffer(text), error);
        EXPECT_EQ(error, asio::error::eof);
        return text;
    }

    /// Looks again and again, on the server's thread.
    template <class Condition>
    bool eventually(Condition condition) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
        bool holds = false;
        while (!holds && std::chrono::steady_clock::now() < end) {
            on_server([&] { holds = condition(); });
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        return holds;
    }

    /// The request with the Host that the gate of TCP wants, in the place of "x".
    [[nodiscard]] std::string to_tcp(std::string request) const {
        const std::string host = "Host: x\r\n";
        const auto at = request.find(host);
        if (at == request.npos) return request;
        return request.replace(
            at, host.size(),
            "Host: 127.0.0.1:" + std::to_string(port_) + "\r\nContent-Type: application/json\r\n");
    }

    template <class Socket>
    std::string ask(Socket socket, const std::string& bytes) {
        asio::write(socket, asio::buffer(to_tcp(bytes)));
        return rest(socket);
    }

    [[nodiscard]] std::uint64_t refused(Limit limit) {
        std::uint64_t count = 0;
        on_server([&] { count = limits_->refused(limit); });
        return count;
    }

    tests::TempDir dir_;
    std::filesystem::path socket_path_ = dir_.path() / "control.sock";
    asio::io_context io_{1};
    asio::io_context client_io_{1};
    asio::executor_work_guard<asio::io_context::executor_type> work_{io_.get_executor()};
    SharedLimits limits_ = std::make_shared<Limits>();
    std::optional<HttpServer> server_;
    std::uint16_t port_ = 0;
    std::thread thread_{[this] { io_.run(); }};
};

const std::string last = "Connection: close\r\n";
const std::string put_large = "PUT / HTTP/1.1\r\nContent-Length: 4000000\r\n" + last + "\r\n";

TEST_F(HttpServerTest, AnswersOverTcpAndTheSocket) {
    start();
    const std::string request = "GET /a/b?c=d&e HTTP/1.1\r\nHost: x\r\n" + last + "\r\n";
    EXPECT_NE(port_, 0);
    EXPECT_THAT(ask(connect(), request), testing::EndsWith("\r\n\r\nGET /a/b [c=d&e] 0"));
    EXPECT_THAT(ask(connect(), request), StartsWith("HTTP/1.1 200 OK\r\n"));
    EXPECT_THAT(ask(connect(), request), HasSubstr("Content-Type: text/plain\r\n"));
    EXPECT_THAT(ask(connect(), request), HasSubstr("Content-Length: 18\r\n"));
    EXPECT_EQ(ask(connect_local(), request), ask(connect(), request));
}

TEST_F(HttpServerTest, KeepsAConnectionForManyRequests) {
    start();
    auto socket = connect_local();
    // Three at once: the answers keep their order.
    asio::write(socket, asio::buffer("GET /1 HTTP/1.1\r\nHost: x\r\n\r\n"
                                     "PUT /2 HTTP/1.1\r\nHost: x\r\nContent-Length: 3\r\n\r\nabc"
                                     "GET /3 HTTP/1.1\r\nHost: x\r\n" +
                                     last + "\r\n"));
    const std::string text = rest(socket);
    const auto first = text.find("GET /1 [] 0");
    const auto second = text.find("PUT /2 [] 3");
    const auto third = text.find("GET /3 [] 0");
    ASSERT_NE(third, text.npos);
    EXPECT_LT(first, second);
    EXPECT_LT(second, third);
}

TEST_F(HttpServerTest, ServesManyAtOnce) {
    start();
    std::vector<tcp::socket> clients;
    for (int i = 0; i < 64; ++i)
        clients.push_back(connect());
    for (auto client = clients.rbegin(); client != clients.rend(); ++client) {
        asio::write(*client, asio::buffer(to_tcp("GET / HTTP/1.1\r\nHost: x\r\n" + last + "\r\n")));
        EXPECT_THAT(rest(*client), HasSubstr("GET / [] 0"));
    }
}

TEST_F(HttpServerTest, SaysWhichMethodsAndNothingInAnEmptyAnswer) {
    start();
    EXPECT_THAT(ask(connect(), "GET /allow HTTP/1.1\r\nHost: x\r\n" + last + "\r\n"),
                HasSubstr("Allow: GET, PUT\r\n"));
    const auto empty = ask(connect(), "GET /empty HTTP/1.1\r\nHost: x\r\n" + last + "\r\n");
    EXPECT_THAT(empty, StartsWith("HTTP/1.1 204 No Content\r\n"));
    EXPECT_THAT(empty, testing::EndsWith("\r\n\r\n"));
    EXPECT_THAT(empty, testing::Not(HasSubstr("Content-")));
}

TEST_F(HttpServerTest, HeadIsGetWithoutItsBody) {
    start();
    const auto text = ask(connect(), "HEAD /abc HTTP/1.1\r\nHost: x\r\n" + last + "\r\n");
    EXPECT_THAT(text, HasSubstr("Content-Length: 13\r\n"));  // of "GET /abc [] 0"
    EXPECT_THAT(text, testing::EndsWith("\r\n\r\n"));
}

TEST_F(HttpServerTest, LetsAClientSendABodyThatItAsksFor) {
    start();
    auto socket = connect();
    asio::write(socket, asio::buffer(to_tcp("PUT /x HTTP/1.1\r\nHost: x\r\nExpect: 100-continue\r\n"
                                            "Content-Length: 4\r\n" +
                                            last + "\r\n")));
    const std::string expected = "HTTP/1.1 100 Continue\r\n\r\n";
    std::string text(expected.size(), '\0');
    asio::read(socket, asio::buffer(text));
    EXPECT_EQ(text, expected);
    EXPECT_THAT(ask(std::move(socket), "body"), HasSubstr("PUT /x [] 4"));
}

TEST_F(HttpServerTest, RefusesWhatIsTooLarge) {
    start();
    const auto put = [](std::size_t size) {
        return "PUT / HTTP/1.1\r\nHost: x\r\nConnection: close\r\nContent-Length: " +
               std::to_string(size) + "\r\n\r\n" + std::string(size, 'x');
    };
    constexpr std::size_t most = 8 << 20;
    EXPECT_THAT(ask(connect(), put(most)), HasSubstr("PUT / [] 8388608"));
    const auto body = ask(connect(), put(most + 1));
    EXPECT_THAT(body, StartsWith("HTTP/1.1 413 Payload Too Large\r\n"));
    EXPECT_THAT(body, HasSubstr(R"("detail":"the body or message is larger than 8388608 bytes; )"
                                "http_body_bytes under limits in the configuration allows more"));
    const auto header =
        ask(connect_local(), "GET / HTTP/1.1\r\nX: " + std::string(20'000, 'x') + "\r\n\r\n");
    EXPECT_THAT(header, StartsWith("HTTP/1.1 431 Request Header Fields Too Large\r\n"));
    EXPECT_THAT(header, HasSubstr("http_header_bytes under limits"));
    EXPECT_EQ(refused(Limit::http_body_bytes), 1U);
    EXPECT_EQ(refused(Limit::http_header_bytes), 1U);
}

/// Requests of every kind, to a server that takes 300 bytes of what frames a request.
class HttpFramingTest : public HttpServerTest {
  protected:
    HttpFramingTest() {
        LimitValues values;
        values[Limit::http_header_bytes] = 300;
        start(values);
    }

    /// In writes of so many bytes, each of which the server reads by itself.
    std::string ask_in_pieces(const std::string& bytes, std::size_t size) {
        auto socket = connect_local();
        for (std::size_t at = 0; at < bytes.size(); at += size) {
            asio::write(socket, asio::buffer(bytes.substr(at, size)));
            on_server([] {});
        }
        return rest(socket);
    }

    static std::string put(const std::string& chunks) {
        return "PUT / HTTP/1.1\r\nHost: x\r\n" + last + "Transfer-Encoding: chunked\r\n\r\n" +
               chunks;
    }
};

TEST_F(HttpFramingTest, TakesAHeaderThatIsJustSmallEnoughHoweverItComes) {
    const auto get = [](std::size_t size, const std::string& fields) {
        std::string header = "GET / HTTP/1.1\r\n" + last + fields + "X: \r\n\r\n";
        return header.insert(header.size() - 4, size - header.size(), 'x');
    };
    std::string many;
    for (int i = 0; i < 30; ++i)
        many += "A: b\r\n";
    std::uint64_t refusals = 0;
    for (const std::size_t size : {1, 6, 7, 100, 301}) {
        for (const std::string& fields : {std::string{}, many}) {
            EXPECT_THAT(ask_in_pieces(get(300, fields), size), StartsWith("HTTP/1.1 200 OK"))
                << size;
            EXPECT_EQ(refused(Limit::http_header_bytes), refusals) << size;
            EXPECT_THAT(ask_in_pieces(get(301, fields), size), StartsWith("HTTP/1.1 431 ")) << size;
            EXPECT_EQ(refused(Limit::http_header_bytes), ++refusals) << size;
        }
    }
}

TEST_F(HttpFramingTest, TakesChunksAndWhatBelongsToThem) {
    EXPECT_THAT(ask(connect_local(), put("2\r\nab\r\n1;a=b\r\nc\r\n0\r\nA: b\r\n\r\n")),
                HasSubstr("PUT / [] 3"));
    std::string small;
    for (int i = 0; i < 5000; ++i)
        small += "1\r\nx\r\n";
    EXPECT_THAT(ask(connect_local(), put(small + "0\r\n\r\n")), HasSubstr("PUT / [] 5000"));
}

// Else the body would be the next request.
TEST_F(HttpFramingTest, RefusesABodyWhoseEndItCannotTell) {
    const std::string next = "GET /smuggled HTTP/1.1\r\nHost: x\r\n" + last + "\r\n";
    const auto put = [&](const std::string& fields, const char* version = "1.1") {
        return ask(connect_local(), "PUT / HTTP/" + std::string(version) + "\r\nHost: x\r\n" +
                                        fields + "\r\n\r\n0\r\n\r\n" + next);
    };
    const std::string field = "Transfer-Encoding: ";
    for (const std::string encoding : {"gzip", "xchunked", "chunked, gzip", "gzip, chunked", ""}) {
        for (const std::string more : {"", "\r\nContent-Length: 5"}) {
            const auto answer = put(field + encoding + more);
            EXPECT_THAT(answer, testing::ContainsRegex("^HTTP/1.1 (400|501) ")) << encoding;
            EXPECT_THAT(answer, testing::Not(HasSubstr("GET /smuggled"))) << encoding;
        }
    }
    const std::string chunked = field + "chunked";
    for (const std::string& fields :
         {field + "gzip\r\n" + chunked, chunked + "\r\n" + chunked,
          chunked + "\r\nContent-Length: 5", "Content-Length: 5\r\n" + chunked}) {
        const auto answer = put(fields);
        EXPECT_THAT(answer, testing::ContainsRegex("^HTTP/1.1 (400|501) ")) << fields;
        EXPECT_THAT(answer, testing::Not(HasSubstr("GET /smuggled"))) << fields;
    }
    EXPECT_THAT(put(chunked, "1.0"), StartsWith("HTTP/1.1 501 Not Implemented\r\n"));
    EXPECT_THAT(put(chunked), HasSubstr("GET /smuggled")) << "which is one of its own";
}

TEST_F(HttpFramingTest, RefusesAChunkWithALineThatIsTooLong) {
    const auto chunk = [](std::size_t size) {
        return "1;" + std::string(size - 4, 'x') + "\r\na\r\n0\r\n\r\n";
    };
    for (const std::size_t size : {1, 7, 1000}) {
        EXPECT_THAT(ask_in_pieces(put(chunk(300)), size), HasSubstr("PUT / [] 1")) << size;
        EXPECT_THAT(ask_in_pieces(put(chunk(301)), size), StartsWith("HTTP/1.1 431 ")) << size;
    }
    EXPECT_EQ(refused(Limit::http_header_bytes), 3U);
}

// None of these ends; the server would keep all of it.
TEST_F(HttpFramingTest, RefusesABodyWithoutEndWhoseFramingIsTooLarge) {
    on_server([this] { server_->set_idle(std::chrono::seconds{5}); });
    std::string fields;
    while (fields.size() < 200'000)
        fields += "A: b\r\n";
    std::uint64_t refusals = 0;
    for (const std::string& endless :
         {"1;" + std::string(200'000, 'x'), std::string(200'000, '0'), "1\r\nx\r\n0\r\n" + fields,
          "1\r\nx\r\n0\r\nX: " + std::string(200'000, 'x')}) {
        EXPECT_THAT(ask(connect_local(), put(endless)), StartsWith("HTTP/1.1 431 "));
        EXPECT_EQ(refused(Limit::http_header_bytes), ++refusals);
    }
}

TEST_F(HttpServerTest, TurnsAwayMoreClientsThanADoorIsFor) {
    LimitValues values;
    values[Limit::http_connections] = 2;
    values[Limit::control_connections] = 1;
    start(values);
    const std::string get = to_tcp("GET / HTTP/1.1\r\nHost: x\r\n\r\n");
    const auto answered = [&](auto& socket) {
        asio::write(socket, asio::buffer(get));
        std::string text;
        asio::read_until(socket, asio::dynamic_buffer(text), "GET / [] 0");
        return text;
    };
    auto first = connect();
    auto second = connect();
    auto local = connect_local();
    EXPECT_THAT(answered(first), StartsWith("HTTP/1.1 200 OK"));
    EXPECT_THAT(answered(second), StartsWith("HTTP/1.1 200 OK"));
    EXPECT_THAT(answered(local), StartsWith("HTTP/1.1 200 OK"));
    const auto refusal = ask(connect(), get);
    EXPECT_THAT(refusal, StartsWith("HTTP/1.1 503 Service Unavailable\r\n"));
    EXPECT_THAT(refusal, HasSubstr("more than 2 clients are connected; http_connections under "));
    EXPECT_THAT(ask(connect_local(), get), HasSubstr("control_connections under limits"));
    EXPECT_EQ(refused(Limit::http_connections), 1U);
    EXPECT_EQ(refused(Limit::control_connections), 1U);
    EXPECT_THAT(answered(first), StartsWith("HTTP/1.1 200 OK")) << "it is not disturbed";
    second.close();
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    bool welcome = false;
    while (!welcome && std::chrono::steady_clock::now() < end) {
        welcome = ask(connect(), to_tcp("GET / HTTP/1.1\r\nHost: x\r\n" + last + "\r\n"))
                      .starts_with("HTTP/1.1 200");
    }
    EXPECT_TRUE(welcome) << "there is room again";
}

// Hundreds that are turned away and do not read hold no more than a few descriptors.
TEST_F(HttpServerTest, ClosesAtOnceWhenTooManyAreTurnedAway) {
    LimitValues values;
    values[Limit::http_connections] = 1;
    start(values);
    auto served = connect();
    asio::write(served, asio::buffer(to_tcp("GET / HTTP/1.1\r\nHost: x\r\n\r\n")));
    std::string text;
    asio::read_until(served, asio::dynamic_buffer(text), "GET / [] 0");
    std::vector<tcp::socket> rude;
    for (int i = 0; i < 40; ++i)
        rude.push_back(connect());
    std::size_t told = 0;
    for (tcp::socket& socket : rude)
        told += rest(socket).empty() ? 0 : 1;
    EXPECT_GT(told, 0U);
    EXPECT_LE(told, 16U);
    EXPECT_EQ(refused(Limit::http_connections), 40U);
}

TEST_F(HttpServerTest, RefusesWhatIsNotHttp) {
    start();
    for (const char* bytes : {"BM\n\n\r\n\r\n", "GET\r\n\r\n", "GET / SCIP/2.0\r\n\r\n",
                              "GET / HTTP/1.1\r\nContent-Length: x\r\n\r\n"}) {
        EXPECT_THAT(ask(connect(), bytes), StartsWith("HTTP/1.1 400 Bad Request\r\n")) << bytes;
    }
}

TEST_F(HttpServerTest, ABugInTheHandlerIsA500AndNoMore) {
    start();
    const auto text = ask(connect(), "GET /throw HTTP/1.1\r\nHost: x\r\n" + last + "\r\n");
    EXPECT_THAT(text, StartsWith("HTTP/1.1 500 Internal Server Error\r\n"));
    EXPECT_THAT(ask(connect(), "GET / HTTP/1.1\r\nHost: x\r\n" + last + "\r\n"),
                HasSubstr("200 OK"));
}

TEST_F(HttpServerTest, OutlivesClientsThatVanish) {
    start();
    for (const char* bytes : {"", "GET / HT", "PUT / HTTP/1.1\r\nContent-Length: 9\r\n\r\nab"}) {
        auto socket = connect();
        asio::write(socket, asio::buffer(std::string{bytes}));
        // A reset, not an orderly end.
        socket.set_option(asio::socket_base::linger{true, 0});
        socket.close();
    }
    EXPECT_THAT(ask(connect(), "GET / HTTP/1.1\r\nHost: x\r\n" + last + "\r\n"),
                HasSubstr("200 OK"));
}

TEST_F(HttpServerTest, NoticesThatAClientWhoWaitsHasHungUp) {
    start();
    auto stays = connect();
    auto goes = connect();
    auto goes_in_a_hurry = connect_local();
    auto goes_in_order = connect();
    const std::string request = to_tcp("GET /never HTTP/1.1\r\nHost: x\r\n\r\n");
    asio::write(stays, asio::buffer(request));
    const auto asked = [&](std::size_t clients) {
        return eventually([&] { return waiting.size() == clients; });
    };
    ASSERT_TRUE(asked(1));
    asio::write(goes, asio::buffer(request + request));  // the second hides that it goes
    ASSERT_TRUE(asked(2));
    asio::write(goes_in_a_hurry, asio::buffer(request));
    ASSERT_TRUE(asked(3));
    asio::write(goes_in_order, asio::buffer(request));
    ASSERT_TRUE(asked(4));
    goes.set_option(asio::socket_base::linger{true, 0});
    goes.close();
    goes_in_a_hurry.close();
    // That could be the end of the sending side alone.
    goes_in_order.close();
    EXPECT_TRUE(eventually([] {
        return waiting[1].withdrawn.stop_requested() && waiting[2].withdrawn.stop_requested() &&
               waiting[3].withdrawn.stop_requested();
    }));
    on_server([] {
        EXPECT_FALSE(waiting[0].withdrawn.stop_requested());
        waiting.clear();
    });
}

// As `nc -N` does behind its input.
TEST_F(HttpServerTest, AnswersLateToAClientThatHasEndedItsSendingSide) {
    start();
    const std::string request = to_tcp("GET /never HTTP/1.1\r\nHost: x\r\n\r\n");
    const auto ask = [&](auto socket) {
        asio::write(socket, asio::buffer(request + request));
        socket.shutdown(asio::socket_base::shutdown_send);
        return socket;
    };
    auto tcp_client = ask(connect());
    auto local_client = ask(connect_local());
    for (std::size_t round = 1; round <= 2; ++round) {
        ASSERT_TRUE(eventually([&] { return waiting.size() == 2; }));
        std::this_thread::sleep_for(std::chrono::milliseconds{300});  // three glances
        on_server([&] {
            for (const Waiting& client : std::exchange(waiting, {})) {
                EXPECT_FALSE(client.withdrawn.stop_requested());
                client.respond({.body = "late"});
            }
        });
    }
    for (const std::string& answers : {rest(tcp_client), rest(local_client)}) {
        EXPECT_THAT(answers, testing::EndsWith("late"));
        EXPECT_NE(answers.find("late"), answers.rfind("late")) << answers;
        EXPECT_THAT(answers, testing::StartsWith("HTTP/1.1 102 Processing\r\n\r\nHTTP/1.1 200"));
    }
}

TEST_F(HttpServerTest, CutsAClientThatDoesNotRead) {
    start();
    auto socket = connect_local();
    asio::write(socket,
                asio::buffer(std::string{"GET /cut HTTP/1.1\r\nHost: x\r\nConnection: Upgrade\r\n"
                                         "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
                                         "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"}));
    using namespace std::string_literals;
    asio::write(socket, asio::buffer("\x81\x81\0\0\0\0x"s));
    EXPECT_LT(rest(socket).size(), large) << "what the kernel had";
}

// It does not hear the answer to the first message; the others have come already.
TEST_F(HttpServerTest, OutlivesAClientThatTalksOverAWebSocketAndVanishes) {
    start();
    auto socket = connect_local();
    asio::write(socket,
                asio::buffer(std::string{"GET /talk HTTP/1.1\r\nHost: x\r\nConnection: Upgrade\r\n"
                                         "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
                                         "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"}));
    std::string head;
    asio::read_until(socket, asio::dynamic_buffer(head), "\r\n\r\n");
    ASSERT_THAT(head, StartsWith("HTTP/1.1 101 "));
    using namespace std::string_literals;
    const std::string x = "\x81\x81\0\0\0\0x"s;  // the letter as a text message
    on_server([&] {                              // which looks only when all of this has happened
        asio::write(socket, asio::buffer(x + x + x));
        socket.close();
    });
    EXPECT_THAT(ask(connect(), "GET / HTTP/1.1\r\nHost: x\r\n" + last + "\r\n"),
                HasSubstr("200 OK"));
}

/// A WebSocket by hand, from after its handshake on.
class RawWebSocketTest : public HttpServerTest {
  protected:
    Local::socket open(const std::string& path = "/talk") {
        auto socket = connect_local();
        asio::write(socket, asio::buffer("GET " + path + upgrade_));
        std::string head;
        asio::read_until(socket, asio::dynamic_buffer(head), "\r\n\r\n");
        EXPECT_THAT(head, StartsWith("HTTP/1.1 101 "));
        return socket;
    }

    /// What comes before a text of at least 64 KiB.
    static std::string head_of(std::size_t size) {
        std::string head = "\x81\xff";
        for (int shift = 56; shift >= 0; shift -= 8)
            head += static_cast<char>((size >> shift) & 0xFFU);
        return head + std::string(4, '\0');
    }

    /// A text message of at least 64 KiB.
    static std::string message(std::size_t size) { return head_of(size) + std::string(size, 'x'); }

    /// What comes up to these words.
    static std::string up_to(Local::socket& socket, const std::string& words) {
        std::string text;
        boost::system::error_code error;
        asio::read_until(socket, asio::dynamic_buffer(text), words, error);
        EXPECT_FALSE(error) << error.message();
        return text;
    }

    const std::string upgrade_ =
        " HTTP/1.1\r\nHost: x\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
        "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";
    const std::string request_ = "GET /talk" + upgrade_;
    const std::string policy_ = "\x03\xf0";  ///< code 1008
};

// Who listens by it hears all that happens once the answer is there.
TEST_F(RawWebSocketTest, AnswersOnceTheConversationHasBegun) {
    start();
    open("/sleep");
    EXPECT_TRUE(Sleeper::awake);
}

TEST_F(RawWebSocketTest, EndsWithTheReasonWhenItsFirstMessagesAreTooMany) {
    LimitValues values;
    values[Limit::websocket_queue_bytes] = 1;
    start(values);
    // The end may come with the answer.
    auto socket = connect_local();
    asio::write(socket, asio::buffer("GET /cut" + upgrade_));
    EXPECT_THAT(up_to(socket, "websocket_queue_bytes under limits"),
                AllOf(StartsWith("HTTP/1.1 101 "), HasSubstr(policy_)));
}

// The gate has not seen it, and a proxy in front takes the connection for one of HTTP.
TEST_F(RawWebSocketTest, BeginsByNoTrailer) {
    start();
    const std::string upgrade =
        "Connection: Upgrade\r\n" + request_.substr(request_.find("Upgrade: "));
    EXPECT_THAT(ask(connect_local(), "GET /talk HTTP/1.1\r\nTransfer-Encoding: chunked\r\n" + last +
                                         "\r\n0\r\n" + upgrade),
                HasSubstr("GET /talk []"));
}

// They would be lost, and what follows would be taken for frames.
TEST_F(RawWebSocketTest, SaysThatFramesMustWaitForTheAnswer) {
    start();
    const std::string answer = ask(connect_local(), request_ + "\x81");
    EXPECT_THAT(answer, StartsWith("HTTP/1.1 400 "));
    EXPECT_THAT(answer, HasSubstr("must wait for the answer"));
}

TEST_F(RawWebSocketTest, EndsWithTheReasonWhenItSendsTooOften) {
    LimitValues values;
    values[Limit::websocket_messages_per_s] = 2;
    start(values);
    auto slow = open();
    using namespace std::string_literals;
    const std::string x = "\x81\x81\0\0\0\0x"s;
    asio::write(slow, asio::buffer(x + x));
    const std::string echoes = "\x81\x01x\x81\x01x";
    EXPECT_EQ(up_to(slow, echoes), echoes);
    EXPECT_EQ(refused(Limit::websocket_messages_per_s), 0U);
    auto quick = open();
    std::string many;
    for (int i = 0; i < 20; ++i)
        many += x;
    asio::write(quick, asio::buffer(many));
    EXPECT_THAT(up_to(quick, "websocket_messages_per_s under limits"),
                HasSubstr(policy_ + "more than 2 messages a second; "));
    EXPECT_EQ(refused(Limit::websocket_messages_per_s), 1U);
}

TEST_F(RawWebSocketTest, EndsWithTheReasonWhenItPingsTooOften) {
    LimitValues values;
    values[Limit::websocket_messages_per_s] = 2;
    start(values);
    using namespace std::string_literals;
    const std::string ping = "\x89\x80\0\0\0\0"s;
    const std::string pong = "\x8a\x80\0\0\0\0"s;
    for (const std::string& frame : {ping, pong}) {
        auto quick = open();
        std::string many;
        for (int i = 0; i < 20; ++i)
            many += frame;
        asio::write(quick, asio::buffer(many));
        EXPECT_THAT(up_to(quick, "websocket_messages_per_s under limits"),
                    HasSubstr(policy_ + "more than 2 messages a second; "));
        quick.close();
    }
    EXPECT_EQ(refused(Limit::websocket_messages_per_s), 2U);
}

TEST_F(RawWebSocketTest, EndsWithTheReasonWhenItDoesNotReadItsAnswers) {
    constexpr std::size_t size = 500'000;  // more than the kernel keeps
    LimitValues values;
    values[Limit::websocket_queue_bytes] = size;
    start(values);
    auto rude = open();
    asio::write(rude, asio::buffer(message(size)));  // one may always be on its way
    asio::write(rude, asio::buffer(message(size)));
    EXPECT_TRUE(eventually([&] { return limits_->refused(Limit::websocket_queue_bytes) == 1; }));
    EXPECT_THAT(up_to(rude, "websocket_queue_bytes under limits"),
                HasSubstr(policy_ + "more than 500000 bytes wait to be read; "));
}

TEST_F(RawWebSocketTest, EndsAtAMessageThatIsTooLarge) {
    constexpr std::size_t most = 100'000;
    LimitValues values;
    values[Limit::http_body_bytes] = most;
    start(values);
    auto socket = open();
    asio::write(socket, asio::buffer(message(most)));
    EXPECT_EQ(up_to(socket, std::string(most, 'x')).size(), 10 + most);
    asio::write(socket, asio::buffer(message(most + 1)));
    EXPECT_THAT(up_to(socket, "http_body_bytes under limits"),
                AllOf(HasSubstr("\x03\xf1"), HasSubstr("100000 bytes")));  // code 1009
    socket.close();
    EXPECT_TRUE(eventually([&] { return limits_->refused(Limit::http_body_bytes) == 1; }));

    // No room is made for what is only said to come.
    for (const std::size_t said : {std::size_t{1} << 40U, std::size_t{1} << 62U, ~std::size_t{0}}) {
        auto boaster = open();
        asio::write(boaster, asio::buffer(head_of(said) + "x"));
        EXPECT_THAT(ask(connect_local(), "GET / HTTP/1.1\r\n" + last + "\r\n"),
                    StartsWith("HTTP/1.1 200 "));
    }
}

TEST_F(HttpServerTest, AnswersOthersWhileAConversationTakesALongMessage) {
    start();
    auto socket = connect_local();
    const std::string message(1 << 20, 'x');
    std::string bytes =
        "GET /nibble HTTP/1.1\r\nHost: x\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
        "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";
    asio::write(socket, asio::buffer(bytes));
    std::string head;
    asio::read_until(socket, asio::dynamic_buffer(head), "\r\n\r\n");
    using namespace std::string_literals;
    asio::write(socket, asio::buffer("\x81\xff\0\0\0\0\0\x10\0\0\0\0\0\0"s + message));
    EXPECT_THAT(ask(connect(), "GET / HTTP/1.1\r\nHost: x\r\n" + last + "\r\n"),
                HasSubstr("200 OK"));
    EXPECT_EQ(socket.available(), 0U) << "it has not had enough yet";
    std::string answer(5, '\0');
    asio::read(socket, asio::buffer(answer));
    EXPECT_EQ(answer,
              "\x81\x03"
              "all");
}

TEST_F(HttpServerTest, DropsAClientThatNeverFinishes) {
    start();
    on_server([this] { server_->set_idle(std::chrono::milliseconds{50}); });
    auto silent = connect();
    auto slow = connect_local();
    asio::write(slow, asio::buffer(std::string{"GET / HTTP/1.1\r\nHo"}));
    EXPECT_EQ(rest(silent), "");
    EXPECT_EQ(rest(slow), "");
}

TEST_F(HttpServerTest, LetsAClientTakeItsTimeThatGoesOn) {
    start();
    on_server([this] { server_->set_idle(std::chrono::milliseconds{500}); });
    const auto pause = [] { std::this_thread::sleep_for(std::chrono::milliseconds{100}); };
    std::string piece(large / 8, 'x');
    auto slow = connect_local();
    asio::write(slow, asio::buffer(put_large));
    for (int i = 0; i < 8; ++i) {
        pause();
        asio::write(slow, asio::buffer(piece));
    }
    EXPECT_THAT(rest(slow), HasSubstr("PUT / [] 4000000"));

    auto reader = connect_local();
    asio::write(reader, asio::buffer("GET /large HTTP/1.1\r\n" + last + "\r\n"));
    for (int i = 0; i < 8; ++i) {
        pause();
        asio::read(reader, asio::buffer(piece));
    }
    EXPECT_THAT(rest(reader), testing::EndsWith("xxx"));

    auto gone = connect_local();
    asio::write(gone, asio::buffer("GET /large HTTP/1.1\r\n" + last + "\r\n"));
    std::this_thread::sleep_for(std::chrono::milliseconds{1500});
    EXPECT_LT(rest(gone).size(), large) << "it has taken nothing for too long";
}

// Each time it has taken or sent something within its 500 ms, but it would be at it for 4 s.
TEST_F(HttpServerTest, EndsWithAClientThatGoesOnTooSlowly) {
    start();
    on_server([this] { server_->set_idle(std::chrono::milliseconds{500}); });
    const auto slowly = [](auto transfer) {
        boost::system::error_code error;
        std::size_t passed = 0;
        for (std::string piece(100'000, 'x'); !error && passed < large; passed += piece.size()) {
            std::this_thread::sleep_for(std::chrono::milliseconds{100});
            transfer(asio::buffer(piece), error);
        }
        return error;
    };
    auto reader = connect_local();
    asio::write(reader, asio::buffer("GET /large HTTP/1.1\r\n" + last + "\r\n"));
    EXPECT_TRUE(slowly([&](auto piece, auto& error) { asio::read(reader, piece, error); }));
    auto sender = connect_local();
    asio::write(sender, asio::buffer(put_large));
    EXPECT_TRUE(slowly([&](auto piece, auto& error) { asio::write(sender, piece, error); }));
}

TEST_F(HttpServerTest, TakesWhatServersMustTake) {
    start();
    const std::string here = "127.0.0.1:" + std::to_string(port_);
    const std::string host = "Host: " + here + "\r\n";
    EXPECT_THAT(ask(connect(), "\r\n\r\nGET /a HTTP/1.1\r\n" + host + last + "\r\n"),
                HasSubstr("GET /a []"))
        << "empty lines in front";
    const auto as_to_a_proxy = [&](const std::string& target) {
        return ask(connect(), "GET " + target + " HTTP/1.1\r\n" + host + last + "\r\n");
    };
    EXPECT_THAT(as_to_a_proxy("HTTP://" + here + "/a/b?c"), HasSubstr("GET /a/b [c]"));
    EXPECT_THAT(as_to_a_proxy("http://" + here + "?c"), HasSubstr("GET / [c]"));
    EXPECT_THAT(as_to_a_proxy("http://evil.example/a"), StartsWith("HTTP/1.1 403 "));
    EXPECT_THAT(ask(connect_local(), "PUT / HTTP/1.1\r\nContent-Length: 1\r\n" + last +
                                         "Expect: 100-Continue\r\n\r\nx"),
                StartsWith("HTTP/1.1 100 Continue"));
}

TEST_F(HttpServerTest, TheSocketIsForItsUserAndGroupAndGoesAtTheEnd) {
    const mode_t before = ::umask(077);
    start();
    ::umask(before);
    struct stat status = {};
    ASSERT_EQ(::stat(socket_path_.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777, 0660u);
    EXPECT_EQ(status.st_gid, ::getegid());
    on_server([this] { server_->close(); });
    EXPECT_FALSE(std::filesystem::exists(socket_path_));
}

TEST_F(HttpServerTest, ReplacesASocketThatWasLeftBehind) {
    Local::acceptor(client_io_, Local::endpoint(socket_path_.string())).close();
    ASSERT_TRUE(std::filesystem::exists(socket_path_));
    start();
    EXPECT_THAT(ask(connect_local(), "GET / HTTP/1.1\r\nHost: x\r\n" + last + "\r\n"),
                HasSubstr("200 OK"));
}

TEST_F(HttpServerTest, NeverTakesWhatAnotherHas) {
    const auto failure = [this](const auto& where) {
        return on_server([&] { server_->listen(where); });
    };
    start();
    EXPECT_EQ(failure(socket_path_),
              "cannot listen on " + socket_path_.string() + ": another program listens there");
    const auto file = dir_.write("file", "precious");
    EXPECT_EQ(failure(file), "cannot listen on " + file.string() + ": it is there and no socket");
    EXPECT_TRUE(std::filesystem::exists(file));
    EXPECT_EQ(failure(dir_.path() / "no" / "socket"), "cannot listen on " +
                                                          (dir_.path() / "no" / "socket").string() +
                                                          ": No such file or directory");
    EXPECT_EQ(failure(Address{"127.0.0.1", port_}),
              "cannot listen on 127.0.0.1:" + std::to_string(port_) + ": Address already in use");
}

TEST_F(HttpServerTest, ClosesItsConnectionsWhenItEnds) {
    start();
    auto idle = connect();
    auto busy = connect_local();
    asio::write(busy, asio::buffer(std::string{"PUT / HTTP/1.1\r\nContent-Length: 9\r\n\r\nab"}));
    // A whole exchange later, both are known to be accepted.
    ask(connect(), "GET / HTTP/1.1\r\nHost: x\r\n" + last + "\r\n");
    on_server([this] { server_.reset(); });
    EXPECT_EQ(rest(idle), "");
    boost::system::error_code error;
    std::string text;
    asio::read(busy, asio::dynamic_buffer(text), error);
    EXPECT_EQ(text, "");
    EXPECT_TRUE(error);
    tcp::socket late{client_io_};
    EXPECT_THROW(late.connect({asio::ip::make_address("127.0.0.1"), port_}),
                 boost::system::system_error);
}

TEST(HttpServer, MayEndBeforeItsContextEverRuns) {
    asio::io_context io{1};
    HttpServer server{io.get_executor(), echo};
    EXPECT_NE(server.listen(Address{"127.0.0.1", 0}).port, 0);
}

}  // namespace
}  // namespace scipd::daemon
