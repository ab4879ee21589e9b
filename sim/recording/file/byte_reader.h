// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Takes numbers and texts off the front of bytes. Whoever reads past the end gets zeros and empty
// texts, and asks once, when all is read, whether that happened. A value; no thread rule.
#pragma once

#include <algorithm>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace scipd::sim {

class ByteReader {
  public:
    explicit ByteReader(std::string_view bytes, std::endian order = std::endian::little)
        : rest_(bytes), order_(order) {}

    template <std::unsigned_integral Number>
    Number number() {
        const std::string_view bytes = take(sizeof(Number));
        Number value = 0;
        for (std::size_t i = 0; i < bytes.size(); ++i) {
            const std::size_t at = order_ == std::endian::little ? bytes.size() - 1 - i : i;
            value = static_cast<Number>(value << 8 | static_cast<unsigned char>(bytes[at]));
        }
        return value;
    }
    float float32() { return std::bit_cast<float>(number<std::uint32_t>()); }
    double float64() { return std::bit_cast<double>(number<std::uint64_t>()); }

    /// Exactly so many bytes, which stay where they are; none if there are fewer.
    std::string_view take(std::uint64_t count) {
        if (count > rest_.size()) {
            too_short_ = true;
            rest_ = {};
            return {};
        }
        const std::string_view bytes = rest_.substr(0, count);
        rest_.remove_prefix(count);
        return bytes;
    }
    /// A length of 32 bits and as many bytes.
    std::string_view text() { return take(number<std::uint32_t>()); }
    void skip(std::uint64_t count) { (void)take(count); }

    [[nodiscard]] std::string_view rest() const { return rest_; }
    [[nodiscard]] bool at_end() const { return rest_.empty(); }
    /// Whether anything was read that was not there.
    [[nodiscard]] bool too_short() const { return too_short_; }

  private:
    std::string_view rest_;
    std::endian order_;
    bool too_short_ = false;
};

}  // namespace scipd::sim
