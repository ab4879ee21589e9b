// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Requests to a running scipd's control socket, as `curl --unix-socket` makes them, and its
// WebSockets. Blocking.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include <nlohmann/json_fwd.hpp>

namespace scipd::tests {

struct ControlAnswer {
    int status = 0;
    std::string body;
};

/// Makes the request on a new connection.
ControlAnswer control_request(const std::filesystem::path& socket, const std::string& method,
                              const std::string& path, const std::string& body = {});

/// Throws std::runtime_error if the answer is not 200.
nlohmann::json control_get(const std::filesystem::path& socket, const std::string& path);

class WebSocketClient {
  public:
    /// Throws boost::system::system_error if scipd refuses it. So do all members below.
    WebSocketClient(const std::filesystem::path& socket, const std::string& path);
    ~WebSocketClient();
    WebSocketClient(const WebSocketClient&) = delete;
    WebSocketClient& operator=(const WebSocketClient&) = delete;

    void send(const std::string& message);
    /// Waits for the next message without a time limit.
    [[nodiscard]] std::string receive();

  private:
    struct Connection;

    std::unique_ptr<Connection> connection_;
};

}  // namespace scipd::tests
