// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/npy/npy.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/recording/file/byte_reader.h"
#include "sim/recording/values/recorded_scan.h"
#include "sim/text/quote.h"
#include "sim/text/text_number.h"

namespace scipd::sim {
namespace {

constexpr std::size_t longest_header = std::size_t{64} << 10;
constexpr std::uint64_t most_steps = 1'000'000;

/// The array by the header of the file.
struct Array {
    char kind = 'f';  ///< f, i or u, as NumPy names them
    std::size_t number_bytes = 8;
    std::endian order = std::endian::little;
    std::uint64_t begin = 0;  ///< of the numbers, bytes
    std::uint64_t scans = 1;
    std::uint64_t steps = 0;
    std::uint64_t values = 1;  ///< of a step: a range, or a range and an intensity
};

/// The text behind a key of the dictionary.
std::string_view behind(std::string_view dictionary, std::string_view key) {
    const std::size_t found = dictionary.find(key);
    return found == dictionary.npos ? std::string_view{}
                                    : trimmed(dictionary.substr(found + key.size()));
}

/// Reads a type such as '<f8', with its quotes.
Expected<> read_type(std::string_view type, Array& array) {
    if (!type.starts_with('\'')) return refuse("its numbers have no type, or several");
    type.remove_prefix(1);
    const std::string_view name = type.substr(0, type.find('\''));
    const bool known = name.size() == 3 && std::string_view("<>|=").find(name[0]) != name.npos &&
                       std::string_view("fiu").find(name[1]) != name.npos &&
                       std::string_view("1248").find(name[2]) != name.npos;
    if (!known || (name[1] == 'f' && name[2] < '4'))
        return refuse("its numbers are " + quote(name) +
                      "; save integers, float32 or float64: numpy.save(FILE, a.astype('f4'))");
    array.order = name[0] == '>' ? std::endian::big : std::endian::little;
    array.kind = name[1];
    array.number_bytes = static_cast<std::size_t>(name[2] - '0');
    return {};
}

/// Reads a tuple such as (100, 1081, 2).
Expected<> read_shape(std::string_view tuple, Array& array) {
    const std::size_t end = tuple.find(')');
    if (!tuple.starts_with('(') || end == tuple.npos) return refuse("its header has no shape");
    std::vector<std::uint64_t> shape;
    for (std::string_view rest = tuple.substr(1, end - 1); !trimmed(rest).empty();) {
        const std::string_view word = rest.substr(0, rest.find(','));
        const auto length = parse_number(trimmed(word));
        if (!length || *length < 0 || *length > 1e12)
            return refuse("a length in its shape is " + quote(word));
        shape.push_back(static_cast<std::uint64_t>(*length));
        rest.remove_prefix(std::min(word.size() + 1, rest.size()));
    }
    if (shape.empty() || shape.size() > 3)
        return refuse(
            "its array must have one, two or three dimensions: scans x steps x "
            "(range, intensity)");
    if (shape.size() == 1) shape.insert(shape.begin(), 1);
    array.scans = shape[0];
    array.steps = shape[1];
    if (shape.size() > 2) array.values = shape[2];
    if (array.values < 1 || array.values > 2)
        return refuse("its third dimension must be 1 or 2: range, or range and intensity");
    if (array.steps < 1 || array.steps > most_steps)
        return refuse("a scan of " + std::to_string(array.steps) + " steps is none");
    return {};
}

/// Takes the first bytes of the file, `longest_header` or all of them.
Expected<Array> parse_header(std::string_view bytes) {
    constexpr std::string_view magic{"\x93NUMPY", 6};
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
    Array array{.begin = bytes.size() - reader.rest().size()};
    return read_type(behind(dictionary, "'descr':"), array)
        .and_then([&] { return read_shape(behind(dictionary, "'shape':"), array); })
        .map([&] { return array; });
}

double take_number(ByteReader& reader, const Array& array) {
    if (array.kind == 'f') return array.number_bytes == 4 ? reader.float32() : reader.float64();
    const auto value = [&]() -> std::uint64_t {
        if (array.number_bytes == 1) return reader.number<std::uint8_t>();
        if (array.number_bytes == 2) return reader.number<std::uint16_t>();
        return array.number_bytes == 4 ? reader.number<std::uint32_t>()
                                       : reader.number<std::uint64_t>();
    }();
    const auto unused_bits = static_cast<int>(64 - 8 * array.number_bytes);
    if (array.kind == 'u') return static_cast<double>(value);
    return static_cast<double>(static_cast<std::int64_t>(value << unused_bits) >> unused_bits);
}

class Npy final : public Recording {
  public:
    Npy(InputFile file, const Array& array)
        : Recording("npy"), file_(std::move(file)), array_(array) {
        add_stream({.name = "scanner", .type = "NumPy array"});
    }

  private:
    Next do_next() override {
        if (given_ == array_.scans) return std::nullopt;
        const std::size_t size = array_.steps * array_.values * array_.number_bytes;
        const auto bytes = file_.read(array_.begin + given_ * size, size);
        if (!bytes) return tl::unexpected(bytes.error());
        if (bytes->size() < size) {
            warn(file_.name() + " ends after " + std::to_string(given_) + " of its " +
                 std::to_string(array_.scans) + " scans");
            return std::nullopt;
        }
        ++given_;
        return RecordedItem{0, scan_of(*bytes)};
    }

    RecordedScan scan_of(const std::string& bytes) {
        ByteReader reader(bytes, array_.order);
        RecordedScan scan;
        LikelyUnit likely;
        for (std::uint64_t step = 0; step < array_.steps; ++step) {
            scan.ranges.push_back(take_number(reader, array_));
            if (array_.values > 1) scan.intensities.push_back(take_number(reader, array_));
            likely.show(scan.ranges.back(), array_.kind == 'f');
        }
        if (given_ == 1) unit_ = likely.unit();
        scan.unit = unit_;
        return scan;
    }

    InputFile file_;
    Array array_;
    std::uint64_t given_ = 0;  ///< scans
    RangeUnit unit_ = RangeUnit::millimetres;
};

}  // namespace

Expected<std::unique_ptr<Recording>> open_npy(InputFile file) {
    const auto beginning = file.read(0, longest_header);
    if (!beginning) return tl::unexpected(beginning.error());
    const auto array = parse_header(*beginning);
    if (!array) return file.refuse(array.error().why);
    return std::make_unique<Npy>(std::move(file), *array);
}

}  // namespace scipd::sim
