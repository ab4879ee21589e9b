// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Appends numbers and texts to bytes, little end first. A value; no thread rule.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace scipd::sim {

class ByteWriter {
  public:
    template <std::unsigned_integral Number>
    ByteWriter& number(Number value) {
        for (std::size_t i = 0; i < sizeof(Number); ++i)
            bytes_.push_back(static_cast<char>(static_cast<std::uint64_t>(value) >> 8 * i & 0xFF));
        return *this;
    }
    ByteWriter& raw(std::string_view bytes) {
        bytes_.append(bytes);
        return *this;
    }
    /// A length of 32 bits and the bytes.
    ByteWriter& text(std::string_view text) {
        return number(static_cast<std::uint32_t>(text.size())).raw(text);
    }

    [[nodiscard]] const std::string& bytes() const { return bytes_; }

  private:
    std::string bytes_;
};

}  // namespace scipd::sim
