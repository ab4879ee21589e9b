// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/command_table.h"

#include <set>

#include <gtest/gtest.h>

namespace scipd::protocol {
namespace {

TEST(CommandTable, HasNoCodeTwice) {
    std::set<std::string_view> codes;
    for (const Command& command : command_table())
        EXPECT_TRUE(codes.insert(command.code).second) << command.code;
}

TEST(CommandTable, ParametersHaveTheWidthsOfTheWire) {
    EXPECT_EQ(width(Parameters::none), 0U);
    EXPECT_EQ(width(Parameters::digit), 1U);
    EXPECT_EQ(width(Parameters::window), std::string_view("0000108001").size());
    EXPECT_EQ(width(Parameters::scans), std::string_view("0000108001100").size());
}

// Drivers tell urg_library's and UrgBenri's "in adjust mode" from any other answer by this.
TEST(CommandTable, OldModelsRefuseAllButTmInAdjustMode) {
    for (const Command& command : command_table()) {
        for (const Family family : {Family::urg, Family::utm_usb}) {
            if (!command.gate(family).known() || command.code.starts_with("TM")) continue;
            EXPECT_EQ(command.gate(family).refusal(State::adjust), status::undefined)
                << command.code;
        }
    }
}

TEST(CommandTable, AModelMayDifferFromItsFamily) {
    DeviceProfile profile{.family = Family::ust};
    const Command& quit = *find_command("QT", profile);
    EXPECT_EQ(refusal(quit, State::adjust, profile), status::denied);
    profile.deviations = {{"QT", State::adjust, std::nullopt},
                          {"QT", State::standby, Status("03")}};
    EXPECT_EQ(refusal(quit, State::adjust, profile), std::nullopt);
    EXPECT_EQ(refusal(quit, State::standby, profile), Status("03"));
    EXPECT_EQ(refusal(quit, State::error, profile), status::abnormal);
    EXPECT_EQ(refusal(*find_command("PP", profile), State::adjust, profile), status::denied);
}

TEST(CommandTable, ADeviationIsCodeStateAndStatus) {
    EXPECT_EQ(parse_deviation("QT adjust 00"), (Deviation{"QT", State::adjust, status::ok}));
    EXPECT_EQ(parse_deviation("%SL asleep --"), (Deviation{"%SL", State::asleep, std::nullopt}));
    for (const auto none : {"", "QT", "QT adjust", "QT  00", "XX adjust 00", "QT nowhere 00",
                            "QT adjust 0", "QT adjust -", "QT adjust 00 ", " QT adjust 00"})
        EXPECT_EQ(parse_deviation(none), std::nullopt) << none;
}

TEST(CommandTable, NoModelMeasuresWithoutLaserOnARequestForOneScan) {
    for (const Command& command : command_table()) {
        if (!command.brings_one_scan()) continue;
        for (const Gate& gate : command.gates) {
            if (!gate.known()) continue;
            EXPECT_EQ(gate.refusal(State::standby), status::denied) << command.code;
        }
    }
}

}  // namespace
}  // namespace scipd::protocol
