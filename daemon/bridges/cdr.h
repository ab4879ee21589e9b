// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads values from the bytes of a DDS message: CDR in its plain forms, by "Extensible and Dynamic
// Topic Types for DDS" 1.3, 7.4 and 7.6.3. Knows no message. Never reads beyond the bytes: from the
// first value that is not there on, all are zero or empty, and good() is false. Values; any thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace scipd::daemon {

class CdrReader {
  public:
    /// The bytes of a message with their header of four bytes, which tells the form. They must
    /// outlive this.
    explicit CdrReader(std::string_view message);

    std::int32_t int32() { return static_cast<std::int32_t>(uint32()); }
    std::uint32_t uint32();
    double float64();
    template <std::size_t Count>
    std::array<double, Count> float64s() {
        std::array<double, Count> values{};
        for (double& value : values)
            value = float64();
        return values;
    }
    std::string text();

    [[nodiscard]] bool good() const { return good_; }

  private:
    template <class Value>
    Value take();
    std::string_view bytes(std::size_t count, std::size_t alignment);

    std::string_view body_;
    std::size_t at_ = 0;
    std::size_t widest_alignment_ = 8;
    bool little_endian_ = true;
    bool good_ = true;
};

}  // namespace scipd::daemon
