// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// HTTP/1.1 on Unix sockets and TCP addresses: reads requests, hands each to one function, writes
// what it answers; and WebSockets, for those that ask for one. Knows no paths and no JSON. Lives on
// the I/O thread; any number of clients, and whatever they send ends at most their own connection.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include <boost/asio/any_io_executor.hpp>

#include "daemon/config/address.h"
#include "daemon/http/message.h"
#include "daemon/http/web_socket.h"

namespace scipd::daemon {

class HttpPort;
struct HttpService;

struct HttpLimits {
    std::uint32_t header_bytes = 16 * 1024;
    std::uint64_t body_bytes = 1024 * 1024;
    std::chrono::milliseconds idle{60'000};  ///< without a whole request: the connection ends
};

class HttpServer {
  public:
    using Handler = std::function<void(const HttpRequest&, Respond)>;

    /// The handler is called on the executor, and no more once this is closed. It responds when it
    /// can; the client waits, and so do all its further requests.
    HttpServer(boost::asio::any_io_executor executor, Handler handler,
               OpenWebSocket open_web_socket = no_web_sockets, const HttpLimits& limits = {});
    ~HttpServer();
    HttpServer(const HttpServer&) = delete;
    HttpServer& operator=(const HttpServer&) = delete;

    /// For this user alone (mode 0600). A socket that nobody listens on any more is replaced.
    /// Throws std::runtime_error, as the next one does.
    void listen(const std::filesystem::path& socket);

    /// Answers with the port that was really taken.
    Address listen(const Address& address);

    /// Ends all connections and removes the sockets.
    void close();

  private:
    static std::variant<HttpResponse, Converse> no_web_sockets(const HttpRequest& request);

    boost::asio::any_io_executor executor_;
    std::shared_ptr<HttpService> service_;  ///< shared with the connections, which may end later
    std::vector<std::shared_ptr<HttpPort>> ports_;
    std::vector<std::filesystem::path> sockets_;
};

}  // namespace scipd::daemon
