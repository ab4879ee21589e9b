// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/bridges/cdr.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace scipd::daemon {
namespace {

constexpr std::size_t header_size = 4;

// Table 60 of the specification, the identifiers of plain encodings. Their lowest bit tells the
// order of bytes.
constexpr unsigned cdr = 0x0000;
constexpr unsigned cdr2 = 0x0006;

}  // namespace

CdrReader::CdrReader(std::string_view message) {
    if (message.size() < header_size) {
        good_ = false;
        return;
    }
    const auto high = static_cast<unsigned char>(message[0]);
    const auto low = static_cast<unsigned char>(message[1]);
    const unsigned encoding = high * 256U + low;
    little_endian_ = encoding % 2 == 1;
    good_ = encoding / 2 == cdr / 2 || encoding / 2 == cdr2 / 2;
    if (encoding / 2 == cdr2 / 2) widest_alignment_ = 4;
    body_ = message.substr(header_size);
}

std::string_view CdrReader::bytes(std::size_t count, std::size_t alignment) {
    const std::size_t step = std::min(alignment, widest_alignment_);
    const std::size_t begin = (at_ + step - 1) / step * step;
    if (!good_ || begin > body_.size() || count > body_.size() - begin) {
        good_ = false;
        return {};
    }
    at_ = begin + count;
    return body_.substr(begin, count);
}

template <class Value>
Value CdrReader::take() {
    std::array<char, sizeof(Value)> raw{};
    const std::string_view from = bytes(raw.size(), raw.size());
    std::ranges::copy(from, raw.begin());
    if (little_endian_ != (std::endian::native == std::endian::little)) std::ranges::reverse(raw);
    return std::bit_cast<Value>(raw);
}

std::uint32_t CdrReader::uint32() {
    return take<std::uint32_t>();
}

double CdrReader::float64() {
    return take<double>();
}

// The size counts the zero at the end.
std::string CdrReader::text() {
    const std::uint32_t size = uint32();
    const std::string_view with_end = bytes(size, 1);
    return std::string(with_end.substr(0, with_end.find('\0')));
}

}  // namespace scipd::daemon
