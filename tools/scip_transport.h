// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The connection to a scanner: TCP or a tty. One thread.
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
    /// From now on the first SIGINT or SIGTERM does not end the program but makes read() throw
    /// Interrupted. Later ones end the program again.
    virtual void interrupt_on_signals() = 0;
    /// The descriptor, which is the caller's from now on. Nothing else may follow.
    [[nodiscard]] virtual int release() = 0;
};

struct OpenOptions {
    std::chrono::milliseconds connect_timeout{3000};
    int baud = 115200;  ///< for a tty; USB scanners ignore it
};

/// Connects, or opens the tty and puts it into raw mode. Throws protocol::client::Error.
[[nodiscard]] std::unique_ptr<ScipTransport> open_target(const Target& target,
                                                         const OpenOptions& options = {});

}  // namespace scipd::tools
