// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/request.h"

#include <gtest/gtest.h>

#include "tests/protocol/test_profile.h"

namespace scipd::protocol {
namespace {

Request request(const std::string& text, Family family = Family::ust, bool overlong = false) {
    return parse_request({text, overlong}, test_profile(family));
}

TEST(Request, IsCodeParametersAndString) {
    const Request md = request("MD0000108001100;left wheel");
    ASSERT_NE(md.command, nullptr);
    EXPECT_EQ(md.command->code, "MD");
    EXPECT_EQ(md.parameters(), "0000108001100");
    EXPECT_EQ(md.echo, "MD0000108001100;left wheel");
    EXPECT_FALSE(md.fault);
}

TEST(Request, TakesTheLongestCode) {
    EXPECT_EQ(request("TM1").command->code, "TM1");
    EXPECT_EQ(request("TM10").parameters(), "0");
    EXPECT_EQ(request("TM3").command->code, "TM");
    EXPECT_EQ(request("TM").command->code, "TM");
    EXPECT_EQ(request("TM").parameters(), "");
}

TEST(Request, KnowsOnlyTheFamilysCommands) {
    EXPECT_EQ(request("GS0044072501", Family::ust).command, nullptr);
    EXPECT_NE(request("GS0044072501", Family::urg).command, nullptr);
    EXPECT_EQ(request("GE0044072501", Family::urg).command, nullptr);
    EXPECT_NE(request("GE0000108001", Family::utm_usb).command, nullptr);
    EXPECT_EQ(request("RT", Family::utm_usb).command, nullptr);
}

TEST(Request, OfNoKnownCodeHasNoCommand) {
    for (const char* text : {"XX", "V", "vv", "SCIP2", " VV", "%SX", ";VV"})
        EXPECT_EQ(request(text).command, nullptr) << text;
}

TEST(Request, MayCarrySixteenCharactersOfString) {
    EXPECT_FALSE(request("VV;").fault);
    EXPECT_FALSE(request("VV;0123456789 ._+@Z").fault);
    EXPECT_EQ(request("VV;0123456789 ._+@Zz").fault, status::string_too_long);
    EXPECT_EQ(request("VV;a;b").fault, status::string_illegal);
    EXPECT_EQ(request("VV;a-b").fault, status::string_illegal);
    EXPECT_EQ(request("VV;\xe4").fault, status::string_illegal);
    EXPECT_EQ(request("VV;aaaaaaaaaaaaaaaa-").fault, status::string_too_long);
}

TEST(Request, ThatWasCutIsTooLongWhateverItSays) {
    EXPECT_EQ(request("VV;" + std::string(125, '-'), Family::ust, true).fault, status::too_long);
}

}  // namespace
}  // namespace scipd::protocol
