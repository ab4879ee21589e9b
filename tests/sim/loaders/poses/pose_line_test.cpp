// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/poses/pose_line.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

using namespace std::chrono_literals;

PoseLine accepted(std::string_view line) {
    const auto parsed = parse_pose_line(line);
    if (parsed) return *parsed;
    ADD_FAILURE() << line << "\nis refused: " << parsed.error().why;
    return {};
}

std::string refusal(std::string_view line) {
    const auto parsed = parse_pose_line(line);
    return parsed ? "accepted" : parsed.error().why;
}

TEST(PoseLine, saysWhoWhenAndWhere) {
    const auto line =
        accepted(R"({"robot":"rescue","t":12.345,"xyz":[1,2.5,-3],"q":[0,0,0.6,0.8]})");
    EXPECT_EQ(line.robot, "rescue");
    EXPECT_EQ(line.model, "");
    EXPECT_EQ(line.time, 12'345'000'000ns);
    EXPECT_EQ(line.pose.translation_m, glm::dvec3(1.0, 2.5, -3.0));
    EXPECT_DOUBLE_EQ(line.pose.rotation.z, 0.6);
    EXPECT_DOUBLE_EQ(line.pose.rotation.w, 0.8);
}

TEST(PoseLine, needsOnlyAPosition) {
    const auto line = accepted(R"( {"xyz": [1, 2, 3]} )"
                               "\r\n");
    EXPECT_EQ(line.robot, "");
    EXPECT_EQ(line.model, "");
    EXPECT_FALSE(line.time.has_value());
    EXPECT_EQ(line.pose.rotation, glm::dquat(1.0, 0.0, 0.0, 0.0));
}

TEST(PoseLine, movesModelsToo) {
    const auto line = accepted(R"({"model":"door","xyz":[0,0,0]})");
    EXPECT_EQ(line.model, "door");
    EXPECT_EQ(line.robot, "");
}

TEST(PoseLine, rollPitchYawStandForAQuaternion) {
    // A quarter turn to the left takes x to y.
    const auto line = accepted(R"({"xyz":[0,0,0],"rpy":[0,0,1.5707963267948966]})");
    const auto turned = line.pose * glm::dvec3{1.0, 0.0, 0.0};
    EXPECT_NEAR(turned.x, 0.0, 1e-12);
    EXPECT_NEAR(turned.y, 1.0, 1e-12);
}

TEST(PoseLine, quaternionsBecomeUnitLength) {
    const auto line = accepted(R"({"xyz":[0,0,0],"q":[0,0,3,4]})");
    EXPECT_DOUBLE_EQ(line.pose.rotation.z, 0.6);
    EXPECT_DOUBLE_EQ(line.pose.rotation.w, 0.8);
}

TEST(PoseLine, timeKeepsWhatADoubleHolds) {
    EXPECT_EQ(accepted(R"({"t":1700000000,"xyz":[0,0,0]})").time, 1'700'000'000s);
    // 1700000000.5 is a double; the nearest one to .1 is 95367431.640625 ns past the second.
    EXPECT_EQ(accepted(R"({"t":1700000000.5,"xyz":[0,0,0]})").time, 1'700'000'000'500'000'000ns);
    EXPECT_EQ(accepted(R"({"t":1700000000.1,"xyz":[0,0,0]})").time, 1'700'000'000'099'999'905ns);
    EXPECT_EQ(accepted(R"({"t":-0.25,"xyz":[0,0,0]})").time, -250ms);
}

TEST(PoseLine, mayBeALineOfATumFile) {
    const auto line = accepted("1305031102.175304001 1 2 3 0 0 0 1\n");
    EXPECT_EQ(line.time, 1'305'031'102'175'304'001ns);
    EXPECT_EQ(line.pose.translation_m, glm::dvec3(1.0, 2.0, 3.0));
    EXPECT_EQ(line.robot, "");
}

TEST(PoseLine, ofExactlyTheLongestLengthIsRead) {
    std::string line = R"({"xyz":[1,2,3]})";
    line.append(4096 - line.size(), ' ');
    accepted(line);
    EXPECT_EQ(refusal(line + ' '), "the line is longer than 4096 bytes");
}

struct Refused {
    const char* line;
    const char* why;
};

class RefusedPoseLine : public ::testing::TestWithParam<Refused> {};

std::string by_number(const ::testing::TestParamInfo<Refused>& line) {
    return "line_" + std::to_string(line.index);
}

TEST_P(RefusedPoseLine, saysWhy) {
    EXPECT_EQ(refusal(GetParam().line), GetParam().why);
}

constexpr Refused fields[] = {
    {R"({})", "xyz is missing"},
    {R"({"robot":"a","t":1})", "xyz is missing"},
    {R"({"xyz":[1,2]})", "xyz must be an array of 3 numbers"},
    {R"({"xyz":[1,2,3,4]})", "xyz must be an array of 3 numbers"},
    {R"({"xyz":[1,2,"3"]})", "xyz must be an array of 3 numbers"},
    {R"({"xyz":[1,2,null]})", "xyz must be an array of 3 numbers"},
    {R"({"xyz":{"x":1,"y":2,"z":3}})", "xyz must be an array of 3 numbers"},
    {R"({"xyz":[1,2,1e300]})", "xyz must lie within 1e7 m of the origin"},
    {R"({"xyz":[-10000001,0,0]})", "xyz must lie within 1e7 m of the origin"},
    {R"({"xyz":[1,2,3],"q":[0,0,0]})", "q must be an array of 4 numbers"},
    {R"({"xyz":[1,2,3],"q":[0,0,0,0]})", "q must be a quaternion x, y, z, w of length 1"},
    {R"({"xyz":[1,2,3],"q":[1e300,0,0,1]})", "q must be a quaternion x, y, z, w of length 1"},
    {R"({"xyz":[1,2,3],"q":[1e-300,0,0,0]})", "q must be a quaternion x, y, z, w of length 1"},
    {R"({"xyz":[1,2,3],"rpy":[0,0]})", "rpy must be an array of 3 numbers"},
    {R"({"xyz":[1,2,3],"rpy":[0,0,true]})", "rpy must be an array of 3 numbers"},
    {R"({"xyz":[1,2,3],"rpy":[0,0,1e9]})", "rpy must lie within 1e6 rad"},
    {R"({"xyz":[1,2,3],"q":[0,0,0,1],"rpy":[0,0,0]})", "q and rpy exclude each other"},
    {R"({"robot":"a","model":"b","xyz":[1,2,3]})", "robot and model exclude each other"},
    {R"({"robot":7,"xyz":[1,2,3]})", "robot must be a name between double quotes"},
    {R"({"robot":"","xyz":[1,2,3]})", "robot must be a name between double quotes"},
    {R"({"model":null,"xyz":[1,2,3]})", "model must be a name between double quotes"},
    {R"({"t":"12","xyz":[1,2,3]})", "t must be a number of seconds"},
    {R"({"t":1e10,"xyz":[1,2,3]})", "t must lie within 9e9 s of zero"},
    {R"({"t":-1e300,"xyz":[1,2,3]})", "t must lie within 9e9 s of zero"},
    {R"({"xyz":[1,2,3],"yaw":1})",
     "the key 'yaw' is unknown; known are robot, model, t, xyz, q, rpy, v, w"},
    {"{\"xyz\":[1,2,3],\"\u00e9\\n\":1}",
     "the key '\u00e9?' is unknown; known are robot, model, t, xyz, q, rpy, v, w"},
};
INSTANTIATE_TEST_SUITE_P(Fields, RefusedPoseLine, ::testing::ValuesIn(fields), by_number);

constexpr Refused syntax[] = {
    {"", "the line holds no pose"},
    {" \t\r\n", "the line holds no pose"},
    {"# a comment", "the line holds no pose"},
    {R"({"xyz":[1,2,1e999]})", "not JSON: number overflow parsing '1e999'"},
    {R"({"xyz":[1,2,NaN]})",
     "not JSON: parse error at line 1, column 13: syntax error while parsing value - invalid "
     "literal; "
     "last read: '2,N'"},
    {R"({"xyz":[1,2,3]} x)",
     "not JSON: parse error at line 1, column 17: syntax error while parsing value - invalid "
     "literal; "
     "last read: '3]} x'; expected end of input"},
    {"1 2 3", "a pose has 8 columns (t tx ty tz qx qy qz qw), this line has 3"},
    {"[1,2,3]", "a pose has 8 columns (t tx ty tz qx qy qz qw), this line has 1"},
    {"1 2 3 inf 0 0 0 1", "tz must be a finite number, not 'inf'"},
    {"1 2 3 4 0 0 0 0x1", "qw must be a finite number, not '0x1'"},
    {"1 2 3 4 0 0 0 2",
     "qx qy qz qw must be a quaternion of length 1, not 2; divide each by that, or see whether the "
     "columns are these"},
};
INSTANTIATE_TEST_SUITE_P(Syntax, RefusedPoseLine, ::testing::ValuesIn(syntax), by_number);

TEST(PoseLine, refusalsArePrintableWhateverCame) {
    std::string line = R"({"xyz":[1,2,3],")";
    for (int byte = 1; byte < 256; ++byte)
        line += static_cast<char>(byte);
    for (const auto& text : {line, "\x80\xff" + line, std::string(3000, '[')}) {
        const std::string said = refusal(text);
        EXPECT_EQ(printable(said, said.size()), said);
    }
}

TEST(PoseLine, deepNestingIsHarmless) {
    EXPECT_NE(refusal(R"({"xyz":)" + std::string(4000, '[')), "accepted");
    EXPECT_EQ(refusal(R"({"xyz":)" + std::string(2000, '[') + std::string(2000, ']') + '}'),
              "nests deeper than 8 levels");
}

}  // namespace
}  // namespace scipd::sim
