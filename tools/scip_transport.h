// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The way to a scanner: a TCP connection or a tty. One thread.
#pragma once

#include <chrono>
#include <exception>
#include <memory>

#include "protocol/client/transport.h"
#include "tools/target.h"

namespace scipd::tools {

/// Thrown by read(): the user wants the program to end.
class Interrupted : public std::exception {
  public:
    [[nodiscard]] const char* what() const noexcept override { return "interrupted"; }
};

class ScipTransport : public protocol::client::Transport {
  public:
    /// From now on SIGINT and SIGTERM do not end the program but make read() throw Interrupted,
    /// once; after that they end it again.
    virtual void interrupt_on_signals() = 0;
};

struct OpenOptions {
    std::chrono::milliseconds connect_timeout{3000};
    int baud = 115200;  ///< for a tty; a USB scanner does not care
};

/// Connects, or opens the tty and puts it into raw mode. Throws protocol::client::Error.
[[nodiscard]] std::unique_ptr<ScipTransport> open_target(const Target& target,
                                                         const OpenOptions& options = {});

}  // namespace scipd::tools
