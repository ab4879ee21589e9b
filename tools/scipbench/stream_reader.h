// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads all steps of all scans of one scanner, and checks every byte. The thread of its loop.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>

#include "protocol/client/scan_request.h"
#include "tools/scipbench/stream_check.h"

namespace scipd::tools {

class StreamReader {
  public:
    /// Connects, asks what scanner it is, and switches its laser on. Throws protocol::client::Error
    /// where it cannot be reached or is none.
    StreamReader(boost::asio::io_context& io, std::string target);

    /// Asks for the stream. `on_read` is called whenever bytes have come or the stream has ended.
    void start(std::function<void()> on_read = [] {});

    [[nodiscard]] const std::string& target() const { return target_; }
    [[nodiscard]] const std::string& model() const { return model_; }
    [[nodiscard]] StreamCheck::Milliseconds period() const { return period_; }
    [[nodiscard]] const StreamCheck& check() const { return *check_; }
    /// Why the stream has ended; empty: it has not.
    [[nodiscard]] const std::string& ended() const { return ended_; }

  private:
    void read();

    boost::asio::posix::stream_descriptor stream_;
    std::string target_;
    std::string model_;
    protocol::client::ScanRequest request_;
    StreamCheck::Milliseconds period_{};
    std::optional<StreamCheck> check_;
    std::function<void()> on_read_;
    std::string ended_;
    std::array<char, 64 * 1024> buffer_;
};

/// How long so many readers should rest between two looks at what has come.
[[nodiscard]] std::chrono::milliseconds rest_for(std::size_t readers);
/// Runs the loop of some readers until it is stopped.
void read_streams(boost::asio::io_context& io, std::chrono::milliseconds rest);

}  // namespace scipd::tools
