// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Whether a client that waits for an answer is still there. Lives on the I/O thread.
#pragma once

namespace scipd::daemon {

class Presence {
  public:
    /// A client of HTTP/1.1 understands interim answers (RFC 9110, 15.2).
    explicit Presence(bool understands_interim = false) : may_ask_(understands_interim) {}

    /// Whether nobody is there to read an answer. Who has only ended its own side may still read. A
    /// client of TCP that has closed looks the same until it is sent something: it is sent an
    /// interim answer, once. To be called while nothing else is sent.
    [[nodiscard]] bool has_gone(int socket);

  private:
    bool may_ask_;
};

}  // namespace scipd::daemon
