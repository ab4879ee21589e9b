// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The client's end of a conversation with a scanner, with all that can be done to one: closed at
// any moment, politely or not, half closed, left unread. Blocking. One thread.
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

class ScannerWire : public protocol::client::Transport {
  public:
    /// Far more than any answer takes on a machine that is busy with other things.
    static constexpr std::chrono::seconds patience{15};

    /// To a port of this machine or of `host`. A `receive_buffer` of the kernel's that is small
    /// makes a slow reader felt early. Throws std::system_error.
    [[nodiscard]] static ScannerWire tcp(std::uint16_t port, int receive_buffer = 0,
                                         const char* host = "127.0.0.1");
    /// The tty as it is: no setting is changed.
    [[nodiscard]] static ScannerWire tty(const std::filesystem::path& path);
    ScannerWire(ScannerWire&& other) noexcept;
    ScannerWire& operator=(ScannerWire&&) = delete;
    ~ScannerWire() override;

    [[nodiscard]] int descriptor() const { return descriptor_; }

    /// Both throw std::runtime_error where the other end is gone.
    void write(std::string_view bytes) override;
    std::size_t read(std::span<char> buffer, std::chrono::milliseconds timeout) override;

    /// The next whole message; nothing: none came within `timeout`.
    [[nodiscard]] std::optional<protocol::client::Message> next_message(
        std::chrono::milliseconds timeout = patience);
    /// The status of the answer to this request, whatever else comes before it.
    [[nodiscard]] std::string ask(const std::string& request);
    /// The next message, which must be an undamaged scan: else throws std::runtime_error.
    [[nodiscard]] protocol::client::ScanMessage next_scan();
    /// Whether the other end closes the connection; what it says until then is thrown away.
    [[nodiscard]] bool ends();

    void half_close() const;
    void close();
    /// Closes with RST: the other end's next read or write fails.
    void abort();

  private:
    explicit ScannerWire(int descriptor) : descriptor_(descriptor) {}

    int descriptor_;
    protocol::client::Decoder decoder_;
    std::string unread_;
};

}  // namespace scipd::tests
