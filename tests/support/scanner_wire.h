// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The client's end of a connection to a scanner. It can do all that clients do: close at any
// moment, cleanly or with a reset, close half, or not read. Blocking. One thread.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "protocol/client/decoder.h"
#include "protocol/client/scan_message.h"
#include "protocol/client/transport.h"

namespace scipd::tests {

/// The port in an address such as 127.0.0.1:10940.
[[nodiscard]] std::uint16_t port_of(const std::string& address);

class ScannerWire;

/// HOST:PORT of the client's end of a TCP connection by IPv4.
[[nodiscard]] std::string local_address(const ScannerWire& wire);

class ScannerWire : public protocol::client::Transport {
  public:
    /// Far longer than any answer takes even on a busy machine.
    static constexpr std::chrono::seconds patience{15};

    /// Connects to a port of this machine or of `host`. With a small `receive_buffer` of the
    /// kernel, scipd soon notices that a reader is slow. Throws std::system_error.
    [[nodiscard]] static ScannerWire tcp(std::uint16_t port, int receive_buffer = 0,
                                         const char* host = "127.0.0.1");
    /// Opens the tty as it is and changes no setting.
    [[nodiscard]] static ScannerWire tty(const std::filesystem::path& path);
    ScannerWire(ScannerWire&& other) noexcept;
    ScannerWire& operator=(ScannerWire&&) = delete;
    ~ScannerWire() override;

    [[nodiscard]] int descriptor() const { return descriptor_; }

    /// Both throw std::runtime_error if the other end is gone.
    void write(std::string_view bytes) override;
    std::size_t read(std::span<char> buffer, std::chrono::milliseconds timeout) override;

    /// The next whole message; nothing if none came within `timeout`.
    [[nodiscard]] std::optional<protocol::client::Message> next_message(
        std::chrono::milliseconds timeout = patience);
    /// The status of the answer to this request. Skips messages that come before it.
    [[nodiscard]] std::string ask(const std::string& request);
    /// The next message. Throws std::runtime_error if it is no undamaged scan.
    [[nodiscard]] protocol::client::ScanMessage next_scan();
    /// Whether the other end closes the connection. Drops what it sends until then.
    [[nodiscard]] bool ends();

    void half_close() const;
    void close();
    /// Closes with RST, so that the other end's next read or write fails.
    void abort();

  private:
    explicit ScannerWire(int descriptor) : descriptor_(descriptor) {}

    int descriptor_;
    protocol::client::Decoder decoder_;
    std::string unread_;
};

}  // namespace scipd::tests
