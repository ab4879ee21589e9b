// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/client/device_info.h"

#include <numbers>
#include <string>
#include <string_view>
#include <variant>

#include <gtest/gtest.h>

#include "protocol/client/decoder.h"

namespace scipd::protocol::client {
namespace {

Message decoded(std::string_view bytes) {
    return Decoder().next(bytes).value();
}

// As a public program has copied it from a UST-10LX.
TEST(Version, IsWhatVvSays) {
    const auto version = std::get<Version>(
        parse_version(decoded("VV\n00P\nVEND:Hokuyo Automatic Co., Ltd.;;\nPROD:UST-10LX;M\n"
                              "FIRM:2.23.0000;K\nPROT:SCIP 2.2;P\nSERI:H1614934;Q\n\n")));
    EXPECT_EQ(version.vendor, "Hokuyo Automatic Co., Ltd.");
    EXPECT_EQ(version.product, "UST-10LX");
    EXPECT_EQ(version.firmware, "2.23.0000");
    EXPECT_EQ(version.protocol, "SCIP 2.2");
    EXPECT_EQ(version.serial, "H1614934");
}

TEST(Version, NamesWhatIsMissing) {
    const auto fault = parse_version(decoded("VV\n00P\nVEND:Hokuyo Automatic Co., Ltd.;;\n\n"));
    EXPECT_EQ(std::get<std::string>(fault), "PROD is missing");
}

// Recorded from a URG-04LX.
constexpr std::string_view urg_parameters =
    "PP\n00P\nMODL:URG-04LX(Hokuyo Automatic Co.,Ltd.);N\nDMIN:20;4\nDMAX:5600;_\nARES:1024;\\\n"
    "AMIN:44;7\nAMAX:725;o\nAFRT:384;6\nSCAN:600;e\n\n";

TEST(Parameters, AreWhatPpSays) {
    const auto parameters = std::get<Parameters>(parse_parameters(decoded(urg_parameters)));
    EXPECT_EQ(parameters.model, "URG-04LX(Hokuyo Automatic Co.,Ltd.)");
    EXPECT_EQ(parameters.dmin_mm, 20);
    EXPECT_EQ(parameters.dmax_mm, 5600);
    EXPECT_EQ(parameters.ares, 1024);
    EXPECT_EQ(parameters.amin, 44);
    EXPECT_EQ(parameters.amax, 725);
    EXPECT_EQ(parameters.afrt, 384);
    EXPECT_EQ(parameters.scan_rpm, 600);
}

TEST(Parameters, TurnStepsIntoAngles) {
    const auto parameters = std::get<Parameters>(parse_parameters(decoded(urg_parameters)));
    EXPECT_DOUBLE_EQ(parameters.angle_rad(384), 0.0);
    EXPECT_DOUBLE_EQ(parameters.angle_rad(384 + 256), std::numbers::pi / 2);
    EXPECT_DOUBLE_EQ(parameters.angle_rad(384 - 128), -std::numbers::pi / 4);
}

TEST(Parameters, TellDistancesFromCodes) {
    const auto parameters = std::get<Parameters>(parse_parameters(decoded(urg_parameters)));
    EXPECT_FALSE(parameters.is_distance(0));
    EXPECT_FALSE(parameters.is_distance(19));
    EXPECT_TRUE(parameters.is_distance(20));
    EXPECT_TRUE(parameters.is_distance(5600));
    EXPECT_FALSE(parameters.is_distance(5601));
}

TEST(Parameters, RefuseWhatIsNoNumber) {
    Message message = decoded(urg_parameters);
    message.lines[2] = "DMAX:5600mm";
    EXPECT_EQ(std::get<std::string>(parse_parameters(message)), "DMAX is no number: \"5600mm\"");
    message = decoded(urg_parameters);
    message.lines[3] = "ARES:0";
    EXPECT_EQ(std::get<std::string>(parse_parameters(message)), "ARES is 0");
}

// Recorded from a URG-04LX with its laser on: 0x6A5404 ms.
TEST(SensorState, ReadsHexadecimalTime) {
    const auto state = std::get<SensorState>(
        parse_state(decoded("II\n00P\nMODL:URG-04LX(Hokuyo Automatic Co.,Ltd.);N\nLASR:ON;9\n"
                            "SCSP:Initial(600[rpm])<-Default setting by user;A\nMESM:CLASSIC;^\n"
                            "SBPS:19200[bps]<-Default setting by user;A\nTIME:6A5404;]\n"
                            "STAT:Sensor works well.;8\n\n")));
    EXPECT_EQ(state.laser, "ON");
    EXPECT_EQ(state.motor_speed, "Initial(600[rpm])<-Default setting by user");
    EXPECT_EQ(state.mode, "CLASSIC");
    EXPECT_EQ(state.bit_rate, "19200[bps]<-Default setting by user");
    EXPECT_EQ(state.time_ms, 6968324U);
    EXPECT_EQ(state.health, "Sensor works well.");
}

// UST-10LX; 0Y\3 is 0, 41, 44 and 3 in groups of six bits.
TEST(SensorState, ReadsEncodedTime) {
    const auto state = std::get<SensorState>(
        parse_state(decoded("II\n00P\nMODL:UST-10LX;D\nLASR:OFF;7\nTIME:0Y\\3;1\n"
                            "STAT:sensor is working normally;k\n\n")));
    EXPECT_EQ(state.time, "0Y\\3");
    EXPECT_EQ(state.time_ms, 41U * 4096U + 44U * 64U + 3U);
}

TEST(SensorState, IsContentWithModelAndHealthOfABrokenScanner) {
    const Message message{.echo = "II",
                          .status = "00",
                          .lines = {"MODL:UTM-30LX", "STAT:Trouble!! Error No. =[00->33]"}};
    const auto state = std::get<SensorState>(parse_state(message));
    EXPECT_EQ(state.health, "Trouble!! Error No. =[00->33]");
    EXPECT_EQ(state.laser, "");
    EXPECT_EQ(state.time_ms, std::nullopt);
}

}  // namespace
}  // namespace scipd::protocol::client
