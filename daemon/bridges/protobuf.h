// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Goes through the fields of a Protocol Buffers message, by the wire format that its makers
// document ("Encoding", protobuf.dev). Knows no message. Never reads beyond the bytes: what is
// damaged ends the walk, and good() is false. Values; any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace scipd::daemon {

class ProtobufReader {
  public:
    /// The bytes must outlive this.
    explicit ProtobufReader(std::string_view bytes) : bytes_(bytes) {}

    /// Goes on to the next field. False: there is none, or the bytes are damaged.
    bool next();
    [[nodiscard]] bool good() const { return good_; }

    /// The number of the field that next() came to, and its value as each kind. Kinds that it is
    /// not of are zero or empty.
    [[nodiscard]] std::uint32_t field() const { return field_; }
    [[nodiscard]] std::int64_t integer() const { return integer_; }
    [[nodiscard]] double float64() const { return float64_; }
    /// A text, or a message in it.
    [[nodiscard]] std::string_view bytes() const { return within_; }

  private:
    std::uint64_t varint();
    std::string_view take(std::uint64_t size);

    std::string_view bytes_;
    bool good_ = true;
    std::uint32_t field_ = 0;
    std::int64_t integer_ = 0;
    double float64_ = 0.0;
    std::string_view within_;
};

}  // namespace scipd::daemon
