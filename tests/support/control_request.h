// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Questions to a running scipd's control socket, as `curl --unix-socket` asks them, and its
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

/// On a connection of its own.
ControlAnswer control_request(const std::filesystem::path& socket, const std::string& method,
                              const std::string& path, const std::string& body = {});

/// Throws std::runtime_error where the answer is not 200.
nlohmann::json control_get(const std::filesystem::path& socket, const std::string& path);

class WebSocketClient {
  public:
    /// Throws boost::system::system_error where it is refused, as all below do.
    WebSocketClient(const std::filesystem::path& socket, const std::string& path);
    ~WebSocketClient();
    WebSocketClient(const WebSocketClient&) = delete;
    WebSocketClient& operator=(const WebSocketClient&) = delete;

    void send(const std::string& message);
    /// The next message, however long it takes.
    [[nodiscard]] std::string receive();

  private:
    struct Connection;

    std::unique_ptr<Connection> connection_;
};

}  // namespace scipd::tests
