// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A line to a scanner of a test, by TCP or by its tty. In lockstep time goes on while it waits, as
// otherwise nothing would come. One thread.
#pragma once

#include <chrono>
#include <functional>
#include <string>

#include "protocol/client/transport.h"

namespace scipd::testing {

class ScannerLine : public protocol::client::Transport {
  public:
    /// Has time go on a little; empty where it does by itself.
    using Meanwhile = std::function<void()>;

    /// Both throw std::system_error.
    [[nodiscard]] static ScannerLine tcp(const std::string& address, Meanwhile meanwhile);
    [[nodiscard]] static ScannerLine tty(const std::string& path, Meanwhile meanwhile);
    ScannerLine(ScannerLine&& other) noexcept;
    ScannerLine& operator=(ScannerLine&&) = delete;
    ~ScannerLine() override;

    /// From then on nothing comes any more, however often one tries.
    void give_up_at(std::chrono::steady_clock::time_point end) { end_ = end; }

    void write(std::string_view bytes) override;
    std::size_t read(std::span<char> buffer, std::chrono::milliseconds timeout) override;

  private:
    ScannerLine(int descriptor, Meanwhile meanwhile);

    [[nodiscard]] bool comes_within(std::chrono::milliseconds timeout) const;

    int descriptor_;
    Meanwhile meanwhile_;
    std::chrono::steady_clock::time_point end_ = std::chrono::steady_clock::time_point::max();
    bool has_asked_ = false;  ///< and nothing has come since
};

}  // namespace scipd::testing
