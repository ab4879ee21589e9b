// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A transport that somebody listens to. One thread.
#pragma once

#include <functional>
#include <string_view>
#include <utility>

#include "protocol/client/transport.h"

namespace scipd::tools {

class TappedTransport final : public protocol::client::Transport {
  public:
    /// Gets what has gone to the scanner, or come from it, at once.
    using Listener = std::function<void(bool to_scanner, std::string_view bytes)>;

    /// `inner` outlives it. Without a listener nobody listens.
    TappedTransport(protocol::client::Transport& inner, Listener listener)
        : inner_(inner), listener_(std::move(listener)) {}

    void write(std::string_view bytes) override {
        inner_.write(bytes);
        if (listener_) listener_(true, bytes);
    }

    std::size_t read(std::span<char> buffer, std::chrono::milliseconds timeout) override {
        const std::size_t count = inner_.read(buffer, timeout);
        if (listener_ && count > 0) listener_(false, {buffer.data(), count});
        return count;
    }

  private:
    protocol::client::Transport& inner_;
    Listener listener_;
};

}  // namespace scipd::tools
