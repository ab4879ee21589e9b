// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// HTTP/1.1 and WebSockets on Unix sockets and TCP addresses. The server reads requests, hands each
// to one function and writes what that answers. It knows no paths and no JSON. It serves any number
// of clients; whatever a client sends ends at most its own connection. Lives on the I/O thread.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/local/stream_protocol.hpp>

#include "daemon/config/address.h"
#include "daemon/http/http_service.h"

namespace scipd::daemon {

class HttpPort;

/// Another program listens at that Unix socket.
class SocketTaken : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

class HttpServer {
  public:
    /// The server calls the handler on the executor, and no more once it is closed. The handler
    /// responds when it can; until then the client and its further requests wait.
    HttpServer(boost::asio::any_io_executor executor, HttpHandler handler,
               OpenWebSocket open_web_socket = no_web_sockets,
               SharedLimits limits = std::make_shared<Limits>());
    ~HttpServer();
    HttpServer(const HttpServer&) = delete;
    HttpServer& operator=(const HttpServer&) = delete;

    /// Makes a socket that this user and a group can open (mode 0660), by default the group of this
    /// process. Replaces a socket that nobody listens on any more. Or takes the descriptor of a
    /// socket that somebody else has made there, and leaves its file as it is. Both listen() throw
    /// std::runtime_error.
    void listen(const std::filesystem::path& socket, std::optional<unsigned> group = {},
                std::optional<int> handed = {});

    /// Lets in clients that the gate has nothing against. Returns the address with the port that
    /// was really taken.
    Address listen(const Address& address, Gate gate = Gate{}, std::optional<int> handed = {});

    /// A connection ends where no whole header has come for so long, or too little of a body or of
    /// an answer has passed (http_connection.h).
    void set_idle(std::chrono::milliseconds idle) { service_->idle = idle; }

    /// Ends all connections and removes the sockets.
    void close();

  private:
    void make_socket(boost::asio::local::stream_protocol::acceptor& acceptor,
                     const std::filesystem::path& socket, std::optional<unsigned> group);
    static std::variant<HttpResponse, Converse> no_web_sockets(const HttpRequest& request);

    boost::asio::any_io_executor executor_;
    std::shared_ptr<HttpService> service_;
    std::vector<std::shared_ptr<HttpPort>> ports_;
    std::vector<std::filesystem::path> sockets_;
};

}  // namespace scipd::daemon
