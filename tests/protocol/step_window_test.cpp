// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/step_window.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "protocol/scan_block.h"
#include "tests/protocol/test_profile.h"

namespace scipd::protocol {
namespace {

using ::testing::ElementsAre;

const DeviceProfile profile = test_profile();
constexpr DataFormat distances{.width = 3};
constexpr DataFormat two_characters{.width = 2};
constexpr DataFormat with_intensity{.width = 3, .intensity = true};

// Steps 2 to 9.
struct Scan {
    std::vector<std::uint32_t> distance = {1002, 1003, 65533, 1005, 4, 65533, 900, 30000};
    std::vector<std::uint32_t> intensity = {12, 13, 14, 15, 16, 17, 18, 19};
};

std::vector<std::uint32_t> values(StepWindow window, DataFormat format = distances,
                                  const Scan& scan = {}) {
    return values_in({{}, 2, scan.distance, scan.intensity}, window, format, profile);
}

TEST(StepWindow, IsReadFromTenDigits) {
    const auto parsed = parse_step_window("0002000903", profile);
    const auto* window = std::get_if<StepWindow>(&parsed);
    ASSERT_NE(window, nullptr);
    EXPECT_EQ(window->first, 2);
    EXPECT_EQ(window->last, 9);
    EXPECT_EQ(window->cluster, 3);
}

TEST(StepWindow, ClusterZeroIsOne) {
    const auto parsed = parse_step_window("0000000000", profile);
    EXPECT_EQ(std::get<StepWindow>(parsed).cluster, 1);
}

TEST(StepWindow, SaysWhatIsWrongFirst) {
    const auto fault = [](std::string_view digits) {
        return std::get<Status>(parse_step_window(digits, profile));
    };
    EXPECT_EQ(fault("000x00x90x"), Status("01"));
    EXPECT_EQ(fault(" 00000x90x"), Status("01"));
    EXPECT_EQ(fault("-00100x90x"), Status("01"));
    EXPECT_EQ(fault("000000x90x"), Status("02"));
    EXPECT_EQ(fault("000000990x"), Status("03"));
    EXPECT_EQ(fault("0000001001"), Status("04"));
    EXPECT_EQ(fault("9999999901"), Status("04"));
    EXPECT_EQ(fault("0006000501"), Status("05"));
}

TEST(StepWindow, BeginsWhereTheModelsStepsDo) {
    DeviceProfile later = test_profile();
    later.first_step = 2;
    EXPECT_EQ(std::get<Status>(parse_step_window("0001000501", later)), Status("04"));
    EXPECT_EQ(std::get<StepWindow>(parse_step_window("0002000501", later)).first, 2);
    // SCIP 1.1 clients read a URG-04LX from 0 on.
    EXPECT_EQ(std::get<StepWindow>(parse_step_window("0000000501", profile)).first, 0);
}

TEST(ParseDigits, TakesDigitsOnly) {
    EXPECT_EQ(parse_digits("0042"), 42);
    EXPECT_EQ(parse_digits("9999"), 9999);
    EXPECT_EQ(parse_digits("+042"), std::nullopt);
    EXPECT_EQ(parse_digits("4:"), std::nullopt);
    EXPECT_EQ(parse_digits("/4"), std::nullopt);
}

TEST(ValuesIn, AreTheStepsAskedFor) {
    EXPECT_THAT(values({2, 9, 1}), ElementsAre(1002, 1003, 65533, 1005, 4, 65533, 900, 30000));
    EXPECT_THAT(values({3, 3, 1}), ElementsAre(1003));
    EXPECT_THAT(values({5, 7, 1}), ElementsAre(1005, 4, 65533));
}

TEST(ValuesIn, StepsThatCannotBeMeasuredHaveTheirCode) {
    EXPECT_THAT(values({0, 3, 1}), ElementsAre(19, 19, 1002, 1003));
    EXPECT_THAT(values({0, 1, 2}), ElementsAre(19));
    EXPECT_THAT(values({0, 1, 1}, with_intensity), ElementsAre(19, 0, 19, 0));
}

TEST(ValuesIn, AGroupIsItsNearestDistance) {
    EXPECT_THAT(values({2, 3, 2}), ElementsAre(1002));
    EXPECT_THAT(values({8, 9, 2}), ElementsAre(900));
}

TEST(ValuesIn, CodesInAGroupCountOnlyWhereThereIsNothingElse) {
    EXPECT_THAT(values({4, 7, 4}), ElementsAre(1005));
    EXPECT_THAT(values({6, 7, 2}), ElementsAre(4));  // two codes: the first
    EXPECT_THAT(values({0, 2, 3}), ElementsAre(1002));
}

TEST(ValuesIn, TheLastGroupMayBeShorter) {
    EXPECT_THAT(values({2, 9, 3}), ElementsAre(1002, 1005, 900));
    EXPECT_THAT(values({2, 9, 99}), ElementsAre(900));
}

TEST(ValuesIn, IntensityIsThatOfTheNearestStep) {
    EXPECT_THAT(values({2, 9, 3}, with_intensity), ElementsAre(1002, 12, 1005, 15, 900, 18));
    EXPECT_THAT(values({5, 6, 1}, with_intensity), ElementsAre(1005, 15, 4, 16));
}

TEST(ValuesIn, EqualDistancesKeepTheFirstOfTheGroup) {
    Scan scan;
    scan.distance.assign(8, 700);
    EXPECT_THAT(values({2, 5, 4}, with_intensity, scan), ElementsAre(700, 12));
}

TEST(ValuesIn, WhatTwoCharactersCannotHoldIsNotSeen) {
    DeviceProfile urg = test_profile(Family::urg);
    urg.codes.nothing = 0;
    const std::vector<std::uint32_t> far = {4095, 4096, 5600};
    const std::vector<std::uint32_t> dark(3);
    EXPECT_THAT(values_in({{}, 2, far, dark}, {2, 4, 1}, two_characters, urg),
                ElementsAre(4095, 0, 0));
    EXPECT_THAT(values_in({{}, 2, far, dark}, {2, 4, 3}, two_characters, urg), ElementsAre(4095));
}

// A recorded UTM-30LX: 271 values for 1081 steps in fours.
TEST(ValuesIn, AreAsManyAsARealScannerSends) {
    const std::vector<std::uint32_t> scan(1081, 1000);
    EXPECT_EQ(values_in({{}, 0, scan, scan}, {0, 1080, 4}, distances, profile).size(), 271U);
    EXPECT_EQ(values_in({{}, 0, scan, scan}, {0, 1080, 3}, distances, profile).size(), 361U);
    EXPECT_EQ(values_in({{}, 0, scan, scan}, {0, 1080, 3}, with_intensity, profile).size(), 722U);
}

}  // namespace
}  // namespace scipd::protocol
