// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Passes values from a confined child (confined.h) to its parent as they lie in memory. Both are
// the same program, so the layouts agree; bytes of a file from outside are never read this way.
// Any thread.
#pragma once

#include <cstdint>
#include <cstdio>
#include <new>
#include <stdexcept>
#include <type_traits>

namespace scipd::sim {

/// Throws std::bad_alloc if the file has no room, as put_all() and put_each() do.
template <typename Value>
void put(const Value& value, std::FILE* out) {
    static_assert(std::is_trivially_copyable_v<Value>);
    if (std::fwrite(&value, sizeof value, 1, out) != 1) throw std::bad_alloc();
}

template <typename Value>
Value take(std::FILE* in) {
    static_assert(std::is_trivially_copyable_v<Value>);
    Value value;
    if (std::fread(&value, sizeof value, 1, in) != 1) {
        throw std::runtime_error("was read, but its data did not arrive from the child process");
    }
    return value;
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
    Container values;
    values.resize(take<std::uint64_t>(in));
    if (values.empty()) return values;
    const auto size = sizeof(typename Container::value_type);
    if (std::fread(values.data(), size, values.size(), in) != values.size()) {
        throw std::runtime_error("was read, but its data did not arrive from the child process");
    }
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
