// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/bridges/protobuf.h"

#include <bit>

namespace scipd::daemon {
namespace {

enum WireType : unsigned { as_varint = 0, eight_bytes = 1, with_length = 2, four_bytes = 5 };

}  // namespace

std::string_view ProtobufReader::take(std::uint64_t size) {
    if (size > bytes_.size()) {
        good_ = false;
        return {};
    }
    const std::string_view taken = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return taken;
}

std::uint64_t ProtobufReader::varint() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
        const std::string_view byte = take(1);
        if (byte.empty()) return 0;
        const auto bits = static_cast<unsigned char>(byte.front());
        value |= std::uint64_t{bits & 0x7fU} << shift;
        if ((bits & 0x80U) == 0) return value;
    }
    good_ = false;
    return 0;
}

bool ProtobufReader::next() {
    integer_ = 0;
    float64_ = 0.0;
    within_ = {};
    if (bytes_.empty() || !good_) return false;
    const std::uint64_t tag = varint();
    field_ = static_cast<std::uint32_t>(tag >> 3U);
    switch (tag & 7U) {
        case as_varint:
            integer_ = static_cast<std::int64_t>(varint());
            break;
        case eight_bytes: {
            std::uint64_t raw = 0;
            unsigned shift = 0;
            for (const char byte : take(8)) {
                raw |= std::uint64_t{static_cast<unsigned char>(byte)} << shift;
                shift += 8;
            }
            float64_ = std::bit_cast<double>(raw);
            break;
        }
        case with_length:
            within_ = take(varint());
            break;
        case four_bytes:
            (void)take(4);
            break;
        default:
            good_ = false;
    }
    return good_;
}

}  // namespace scipd::daemon
