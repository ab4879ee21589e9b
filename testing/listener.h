// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Hears a WebSocket of the control API, until scipd ends or this object does. It has a thread of
// its own.
#pragma once

#include <functional>
#include <memory>
#include <string>

namespace scipd::testing {

class Listener {
  public:
    /// Called on the thread of the listener, with each message.
    using Hear = std::function<void(const std::string& message)>;

    /// The WebSocket is open when this is made. Throws std::runtime_error.
    Listener(const std::string& socket, const std::string& target, Hear hear);
    Listener(const Listener&) = delete;
    Listener& operator=(const Listener&) = delete;
    /// Waits until a call of `hear` has returned.
    ~Listener();

    /// Returns when all that has come is heard.
    void catch_up() const;

  private:
    struct Connection;

    std::unique_ptr<Connection> connection_;
};

}  // namespace scipd::testing
