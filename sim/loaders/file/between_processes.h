// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Passes values between a process and its child (child_process.h) as they lie in memory. Both are
// built together, so that the layouts agree. No file from outside is read this way; but a library
// that such a file has led astray may have written the values: no size is believed, and bool and
// std::optional have functions of their own. Any thread.
#pragma once

#include <cstdint>
#include <cstdio>
#include <new>
#include <optional>
#include <stdexcept>
#include <type_traits>

namespace scipd::sim {

/// Throws std::bad_alloc if the file has no room, as put_all() and put_each() do.
template <typename Value>
void put(const Value& value, std::FILE* out) {
    static_assert(std::is_trivially_copyable_v<Value>);
    if (std::fwrite(&value, sizeof value, 1, out) != 1) throw std::bad_alloc();
}

[[noreturn]] inline void refuse_data() {
    throw std::runtime_error("was read, but its data did not arrive from the child process");
}

template <typename Value>
Value take(std::FILE* in) {
    static_assert(std::is_trivially_copyable_v<Value> && !std::is_same_v<Value, bool>);
    Value value;
    if (std::fread(&value, sizeof value, 1, in) != 1) refuse_data();
    return value;
}

inline bool take_bool(std::FILE* in) {
    return take<std::uint8_t>(in) != 0;
}

template <typename Value>
void put_optional(const std::optional<Value>& value, std::FILE* out) {
    put(value.has_value(), out);
    if (value) put(*value, out);
}

template <typename Value>
std::optional<Value> take_optional(std::FILE* in) {
    if (!take_bool(in)) return std::nullopt;
    return take<Value>(in);
}

/// The number of bytes between where the file stands and its end.
inline std::uint64_t bytes_left(std::FILE* in) {
    const long here = std::ftell(in);
    std::fseek(in, 0, SEEK_END);
    const long end = std::ftell(in);
    std::fseek(in, here, SEEK_SET);
    return static_cast<std::uint64_t>(end - here);
}

/// A string, or a vector of plain values.
template <typename Container>
void put_all(const Container& values, std::FILE* out) {
    using Value = typename Container::value_type;
    static_assert(std::is_trivially_copyable_v<Value>);
    put(std::uint64_t{values.size()}, out);
    if (values.empty()) return;  // data() may be null then, which fwrite() must not get
    if (std::fwrite(values.data(), sizeof(Value), values.size(), out) != values.size()) {
        throw std::bad_alloc();
    }
}

template <typename Container>
Container take_all(std::FILE* in) {
    using Value = typename Container::value_type;
    constexpr std::uint64_t believed = 4096;
    const auto count = take<std::uint64_t>(in);
    if (count > believed && count > bytes_left(in) / sizeof(Value)) refuse_data();
    Container values;
    values.resize(count);
    if (values.empty()) return values;
    if (std::fread(values.data(), sizeof(Value), count, in) != count) refuse_data();
    return values;
}

/// Writes the number of values, then each value with `put_one`.
template <typename Container, typename Put>
void put_each(const Container& values, std::FILE* out, const Put& put_one) {
    put(std::uint64_t{values.size()}, out);
    for (const auto& value : values)
        put_one(value, out);
}

template <typename Container, typename Take>
Container take_each(std::FILE* in, const Take& take_one) {
    Container values;
    for (auto count = take<std::uint64_t>(in); count > 0; --count)
        values.push_back(take_one(in));
    return values;
}

}  // namespace scipd::sim
