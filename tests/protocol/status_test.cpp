// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/status.h"

#include <gtest/gtest.h>

namespace scipd::protocol {
namespace {

TEST(Status, IsItsTwoCharacters) {
    EXPECT_EQ(status::ok.text(), "00");
    EXPECT_EQ(status::scan_follows.text(), "99");
    EXPECT_EQ(status::denied.text(), "10");
    EXPECT_EQ(status::too_short.text(), "0C");
    EXPECT_EQ(status::too_long.text(), "0D");
    EXPECT_EQ(status::undefined.text(), "0E");
    EXPECT_EQ(status::unsupported.text(), "0F");
    EXPECT_EQ(status::string_too_long.text(), "0G");
    EXPECT_EQ(status::string_illegal.text(), "0H");
}

// One number means different things to different commands.
TEST(Status, OfANumberHasANameForEachMeaning) {
    EXPECT_EQ(status::scan::start_not_numeric.text(), "01");
    EXPECT_EQ(status::scan::count_not_numeric.text(), "07");
    EXPECT_EQ(status::setting::unchanged.text(), "03");
    EXPECT_EQ(status::sensitivity::unchanged.text(), "02");
    EXPECT_EQ(status::rehearsal::in_real_trouble.text(), "05");
    EXPECT_EQ(status::ask_again.text(), "01");
}

TEST(Status, ReadsWhatItWrites) {
    EXPECT_EQ(Status::parse("0L"), status::abnormal);
    for (const auto none : {"", "0", "000", "0l", "--", "0 "})
        EXPECT_EQ(Status::parse(none), std::nullopt) << none;
}

TEST(Status, ComparesByText) {
    EXPECT_EQ(Status("00"), status::ok);
    EXPECT_NE(Status("01"), status::ok);
}

}  // namespace
}  // namespace scipd::protocol
