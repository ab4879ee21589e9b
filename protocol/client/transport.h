// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The connection that a driver uses. Tools implement it with a socket or a tty, tests with a
// string.
#pragma once

#include <chrono>
#include <cstddef>
#include <span>
#include <string_view>

namespace scipd::protocol::client {

class Transport {
  public:
    virtual ~Transport() = default;

    /// Writes all of `bytes`. Throws Error if the other end is gone.
    virtual void write(std::string_view bytes) = 0;

    /// Waits for bytes and takes those that there are, at most as many as `buffer` holds. Returns 0
    /// if nothing came within `timeout`. Throws Error if the other end is gone.
    virtual std::size_t read(std::span<char> buffer, std::chrono::milliseconds timeout) = 0;
};

}  // namespace scipd::protocol::client
