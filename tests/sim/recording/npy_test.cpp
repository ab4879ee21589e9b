// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "tests/sim/recording/recordings.h"

namespace scipd::tests {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

/// An array of version 1 of the format.
std::string npy(const std::string& type, const std::string& shape, const std::string& data,
                const std::string& fortran = "False") {
    std::string head =
        "{'descr': '" + type + "', 'fortran_order': " + fortran + ", 'shape': " + shape + ", }";
    head.resize(118 - 1, ' ');
    return std::string("\x93NUMPY\x01\x00\x76\x00", 10) + head + "\n" + data;
}

template <class Number>
std::string raw(const std::vector<Number>& numbers, bool turned = false) {
    std::string bytes;
    for (const Number number : numbers) {
        std::string one(reinterpret_cast<const char*>(&number), sizeof number);
        if (turned) one = {one.rbegin(), one.rend()};
        bytes += one;
    }
    return bytes;
}

TEST(Npy, HoldsScansOfIntegers) {
    const ReadBack back =
        read_bytes(npy("<u2", "(2, 3)", raw<std::uint16_t>({1, 2, 65533, 4, 5, 6})));
    EXPECT_EQ(back.fault, "");
    EXPECT_EQ(back.format, "npy");
    ASSERT_THAT(back.scans(), SizeIs(2));
    EXPECT_THAT(back.scans()[0].ranges, ElementsAre(1, 2, 65533));
    EXPECT_EQ(back.scans()[0].unit, sim::RangeUnit::millimetres);
    EXPECT_THAT(back.scans()[1].ranges, ElementsAre(4, 5, 6));
    EXPECT_THAT(back.scans()[1].intensities, IsEmpty());
}

TEST(Npy, HoldsIntensitiesInAThirdDimension) {
    const ReadBack back = read_bytes(npy("<f8", "(1, 2, 2)", raw<double>({1500.5, 700, 65533, 0})));
    ASSERT_THAT(back.scans(), SizeIs(1));
    EXPECT_THAT(back.scans()[0].ranges, ElementsAre(1500.5, 65533));
    EXPECT_THAT(back.scans()[0].intensities, ElementsAre(700, 0));
    EXPECT_EQ(back.scans()[0].unit, sim::RangeUnit::millimetres);
}

TEST(Npy, HoldsMetresOfEitherOrder) {
    for (const bool big : {false, true}) {
        const ReadBack back =
            read_bytes(npy(big ? ">f4" : "<f4", "(3,)", raw<float>({1.5F, 2.25F, 30.0F}, big)));
        ASSERT_THAT(back.scans(), SizeIs(1));
        EXPECT_THAT(back.scans()[0].ranges, ElementsAre(1.5, 2.25, 30));
        EXPECT_EQ(back.scans()[0].unit, sim::RangeUnit::metres);
    }
}

TEST(Npy, HoldsNegativeIntegers) {
    const ReadBack back = read_bytes(npy("<i4", "(2,)", raw<std::int32_t>({-1, 70000})));
    EXPECT_THAT(back.scans()[0].ranges, ElementsAre(-1, 70000));
    const auto ranges_of = [](const std::string& type, const std::string& data) {
        return read_bytes(npy(type, "(2,)", data)).scans().at(0).ranges;
    };
    EXPECT_THAT(ranges_of("|i1", raw<std::int8_t>({-128, 127})), ElementsAre(-128, 127));
    EXPECT_THAT(ranges_of("|u1", raw<std::uint8_t>({128, 255})), ElementsAre(128, 255));
    EXPECT_THAT(ranges_of("<i2", raw<std::int16_t>({-2, 32767})), ElementsAre(-2, 32767));
    EXPECT_THAT(ranges_of(">i8", raw<std::int64_t>({-5, 1LL << 40}, true)),
                ElementsAre(-5, 1LL << 40));
    EXPECT_THAT(ranges_of("<u8", raw<std::uint64_t>({1ULL << 63, 7})), ElementsAre(0x1p63, 7));
    EXPECT_THAT(ranges_of("<u4", raw<std::uint32_t>({0xFFFFFFFF, 7})), ElementsAre(0xFFFFFFFF, 7));
}

TEST(Npy, IsReadToItsLastWholeScan) {
    const ReadBack back = read_bytes(npy("<u2", "(2, 2)", raw<std::uint16_t>({1, 2, 3})));
    EXPECT_EQ(back.fault, "");
    EXPECT_THAT(back.scans(), SizeIs(1));
    EXPECT_THAT(back.warnings, ElementsAre("FILE ends after 1 of its 2 scans"));
}

TEST(Npy, IsRefusedWithWhatToDo) {
    EXPECT_THAT(read_bytes(npy("<c8", "(2,)", "")).fault, HasSubstr("its numbers are '<c8'"));
    EXPECT_THAT(read_bytes(npy("|O", "(2,)", "")).fault, HasSubstr("its numbers are '|O'"));
    EXPECT_THAT(read_bytes(npy("<f8", "(2, 2)", "", "True")).fault,
                HasSubstr("numpy.ascontiguousarray"));
    EXPECT_THAT(read_bytes(npy("<f8", "(2, 3, 4)", "")).fault, HasSubstr("its third dimension"));
    EXPECT_THAT(read_bytes(npy("<f8", "(1, 2, 3, 4)", "")).fault,
                HasSubstr("one, two or three dimensions"));
    EXPECT_THAT(read_bytes(npy("<f8", "()", "")).fault, HasSubstr("one, two or three dimensions"));
    EXPECT_THAT(read_bytes(npy("<f8", "(0,)", "")).fault, HasSubstr("a scan of 0 steps"));
    EXPECT_THAT(read_bytes("\x93NUMPY\x01").fault, HasSubstr("its header is damaged"));
}

}  // namespace
}  // namespace scipd::tests
