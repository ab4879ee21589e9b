// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/npy/npy_header.h"

#include <optional>
#include <string>

#include "sim/recording/file/byte_reader.h"
#include "sim/text/quote.h"
#include "sim/text/text_number.h"

namespace scipd::sim {
namespace {

constexpr std::string_view magic{"\x93NUMPY", 6};

/// What stands behind a key of the dictionary.
std::string_view behind(std::string_view dictionary, std::string_view key) {
    const std::size_t found = dictionary.find(key);
    return found == dictionary.npos ? std::string_view{}
                                    : trimmed(dictionary.substr(found + key.size()));
}

/// A type such as '<f8', without its quotes.
Expected<> read_type(std::string_view type, NpyHeader& header) {
    if (!type.starts_with('\'')) return refuse("its numbers have no type, or several");
    type.remove_prefix(1);
    const std::string_view name = type.substr(0, type.find('\''));
    const bool known = name.size() == 3 && std::string_view("<>|=").find(name[0]) != name.npos &&
                       std::string_view("fiu").find(name[1]) != name.npos &&
                       std::string_view("1248").find(name[2]) != name.npos;
    const bool small_float = known && name[1] == 'f' && name[2] < '4';
    if (!known || small_float)
        return refuse("its numbers are " + quote(name) +
                      "; save integers, float32 or float64: numpy.save(FILE, a.astype('f4'))");
    header.order = name[0] == '>' ? std::endian::big : std::endian::little;
    header.kind = name[1];
    header.item_bytes = static_cast<std::size_t>(name[2] - '0');
    return {};
}

/// A tuple such as (100, 1081, 2).
Expected<> read_shape(std::string_view tuple, NpyHeader& header) {
    const std::size_t end = tuple.find(')');
    if (!tuple.starts_with('(') || end == tuple.npos) return refuse("its header has no shape");
    std::string_view rest = tuple.substr(1, end - 1);
    while (!trimmed(rest).empty()) {
        const std::string_view word = rest.substr(0, rest.find(','));
        const auto length = parse_number(trimmed(word));
        if (!length || *length < 0 || *length > 1e12)
            return refuse("a length in its shape is " + quote(word));
        header.shape.push_back(static_cast<std::uint64_t>(*length));
        rest.remove_prefix(std::min(word.size() + 1, rest.size()));
    }
    return {};
}

}  // namespace

Expected<NpyHeader> parse_npy_header(std::string_view bytes) {
    ByteReader reader(bytes);
    if (reader.take(magic.size()) != magic) return refuse("is no .npy: it begins otherwise");
    const auto version = reader.number<std::uint8_t>();
    reader.skip(1);
    const std::uint64_t length =
        version == 1 ? reader.number<std::uint16_t>() : reader.number<std::uint32_t>();
    const std::string_view dictionary = reader.take(length);
    if (reader.too_short() || version < 1 || version > 3) return refuse("its header is damaged");
    if (!behind(dictionary, "'fortran_order':").starts_with("False"))
        return refuse(
            "its columns come first; save it by numpy.save(FILE, numpy.ascontiguousarray(a))");
    NpyHeader header;
    header.data_begin = bytes.size() - reader.rest().size();
    return read_type(behind(dictionary, "'descr':"), header)
        .and_then([&] { return read_shape(behind(dictionary, "'shape':"), header); })
        .map([&] { return header; });
}

}  // namespace scipd::sim
