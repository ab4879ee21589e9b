// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a driver talks through. Tools put a socket or a tty behind it, tests a string.
#pragma once

#include <chrono>
#include <cstddef>
#include <span>
#include <string_view>

namespace scipd::protocol::client {

class Transport {
  public:
    virtual ~Transport() = default;

    /// All of `bytes`. Throws Error where the other end is gone.
    virtual void write(std::string_view bytes) = 0;

    /// Waits for bytes and takes what there is, at most what `buffer` holds; 0: nothing came within
    /// `timeout`. Throws Error where the other end is gone.
    virtual std::size_t read(std::span<char> buffer, std::chrono::milliseconds timeout) = 0;
};

}  // namespace scipd::protocol::client
