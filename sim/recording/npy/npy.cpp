// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/npy/npy.h"

#include <string>
#include <type_traits>
#include <utility>

#include "sim/recording/file/byte_reader.h"
#include "sim/recording/npy/npy_header.h"
#include "sim/recording/values/range_unit.h"

namespace scipd::sim {
namespace {

constexpr std::size_t longest_header = std::size_t{64} << 10;
constexpr std::uint64_t most_steps = 1'000'000;

/// An integer of this type, with or without a sign.
template <class Unsigned>
double take_integer(ByteReader& reader, bool is_signed) {
    const auto value = reader.number<Unsigned>();
    if (is_signed) return static_cast<double>(static_cast<std::make_signed_t<Unsigned>>(value));
    return static_cast<double>(value);
}

double take_number(ByteReader& reader, const NpyHeader& header) {
    if (header.kind == 'f') return header.item_bytes == 4 ? reader.float32() : reader.float64();
    const bool is_signed = header.kind == 'i';
    switch (header.item_bytes) {
        case 1:
            return take_integer<std::uint8_t>(reader, is_signed);
        case 2:
            return take_integer<std::uint16_t>(reader, is_signed);
        case 4:
            return take_integer<std::uint32_t>(reader, is_signed);
        default:
            return take_integer<std::uint64_t>(reader, is_signed);
    }
}

/// How an array is cut into scans.
struct Layout {
    std::uint64_t scans = 1;
    std::uint64_t steps = 0;
    std::uint64_t values = 1;  ///< of a step: a range, or a range and an intensity
};

Expected<Layout> layout_of(const std::vector<std::uint64_t>& shape) {
    Layout layout;
    if (shape.empty() || shape.size() > 3)
        return refuse(
            "its array must have one, two or three dimensions: scans x steps x "
            "(range, intensity)");
    layout.steps = shape[shape.size() == 1 ? 0 : 1];
    if (shape.size() > 1) layout.scans = shape[0];
    if (shape.size() > 2) layout.values = shape[2];
    if (layout.values < 1 || layout.values > 2)
        return refuse("its third dimension must be 1 or 2: range, or range and intensity");
    if (layout.steps < 1 || layout.steps > most_steps)
        return refuse("a scan of " + std::to_string(layout.steps) + " steps is none");
    return layout;
}

class Npy final : public Recording {
  public:
    Npy(InputFile file, NpyHeader header, Layout layout)
        : Recording("npy"),
          file_(std::move(file)),
          header_(std::move(header)),
          layout_(layout),
          next_byte_(header_.data_begin) {
        add_stream({.name = "scanner", .type = "NumPy array"});
    }

  private:
    Next do_next() override {
        if (given_ == layout_.scans) return std::nullopt;
        const std::size_t size = layout_.steps * layout_.values * header_.item_bytes;
        const auto bytes = file_.read(next_byte_, size);
        if (!bytes) return tl::unexpected(bytes.error());
        if (bytes->size() < size) {
            warn(file_.name() + " ends after " + std::to_string(given_) + " of its " +
                 std::to_string(layout_.scans) + " scans");
            return std::nullopt;
        }
        next_byte_ += size;
        ++given_;
        return RecordedItem{0, scan_of(*bytes)};
    }

    RecordedScan scan_of(const std::string& bytes) {
        ByteReader reader(bytes, header_.order);
        RecordedScan scan;
        for (std::uint64_t step = 0; step < layout_.steps; ++step) {
            scan.ranges.push_back(take_number(reader, header_));
            if (layout_.values > 1) scan.intensities.push_back(take_number(reader, header_));
        }
        if (given_ == 1) guess_unit(scan.ranges);
        scan.unit = unit_;
        return scan;
    }

    void guess_unit(const std::vector<double>& ranges) {
        LikelyUnit likely;
        for (const double range : ranges)
            likely.show(range, header_.kind == 'f');
        unit_ = likely.unit();
    }

    InputFile file_;
    NpyHeader header_;
    Layout layout_;
    std::uint64_t next_byte_;
    std::uint64_t given_ = 0;
    RangeUnit unit_ = RangeUnit::millimetres;
};

}  // namespace

Expected<std::unique_ptr<Recording>> open_npy(InputFile file) {
    const auto beginning = file.read(0, longest_header);
    if (!beginning) return tl::unexpected(beginning.error());
    auto header = parse_npy_header(*beginning);
    if (!header) return file.refuse(header.error().why);
    const auto layout = layout_of(header->shape);
    if (!layout) return file.refuse(layout.error().why);
    return std::make_unique<Npy>(std::move(file), std::move(*header), *layout);
}

}  // namespace scipd::sim
