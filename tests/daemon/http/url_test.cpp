// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/http/url.h"

#include <gtest/gtest.h>

namespace scipd::daemon {
namespace {

TEST(PercentDecoded, ReadsTwoHexadecimalDigits) {
    EXPECT_EQ(percent_decoded(""), "");
    EXPECT_EQ(percent_decoded("rescue%20robot"), "rescue robot");
    EXPECT_EQ(percent_decoded("%2f%2F+"), "//+") << "a plus is a plus in a path";
    EXPECT_EQ(percent_decoded("%C3%A9"), "\xC3\xA9");
    EXPECT_EQ(percent_decoded("%2520"), "%20") << "once";
    EXPECT_EQ(percent_decoded("a%00b"), std::string("a\0b", 3));
}

TEST(PercentDecoded, IsNothingWhereTheyAreMissing) {
    for (const char* text : {"%", "%2", "a%", "%zz", "%2g", "%+1", "%-1", "% 1", "%0x"})
        EXPECT_EQ(percent_decoded(text), std::nullopt) << text;
}

TEST(QueryValue, IsThatOfTheFirstSuchKey) {
    EXPECT_EQ(query_value("scan=12&x=1", "scan"), "12");
    EXPECT_EQ(query_value("scan=12&x=1", "x"), "1");
    EXPECT_EQ(query_value("x=1&x=2", "x"), "1");
    EXPECT_EQ(query_value("x=", "x"), "");
    EXPECT_EQ(query_value("x=a%3Db=c", "x"), "a=b=c");
    EXPECT_EQ(query_value("&&x=1", "x"), "1");
}

TEST(QueryValue, IsNothingWhereThereIsNone) {
    for (const char* query : {"", "y=1", "xx=1", "x", "x=%", "ax=1"})
        EXPECT_EQ(query_value(query, "x"), std::nullopt) << query;
}

}  // namespace
}  // namespace scipd::daemon
