// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Compares small JSON documents with what the library's own parser makes of them.
#include "sim/loaders/poses/small_json.h"

#include <string>

#include <gtest/gtest.h>

namespace scipd::sim {
namespace {

using Json = nlohmann::json;

TEST(SmallJson, IsWhatTheLibraryReads) {
    for (const std::string text :
         {"null", "true", "-3", "18446744073709551615", "-2.5e-3", R"("")", R"("\u00e4\n\"")", "[]",
          "{}", " [ 1 , [ ] , { } , [[2,\"x\"],false] ] ", R"({"a":{"b":[1,{"c":null}]},"d":-1})",
          R"({"a":1,"b":[2],"a":{"c":3}})", R"({"":{"":{"":0}}})", "\xef\xbb\xbf[1]"}) {
        const auto read = parse_small_json(text);
        ASSERT_TRUE(read) << text << ": " << read.error().why;
        EXPECT_EQ(*read, Json::parse(text)) << text;
        EXPECT_EQ(read->dump(), Json::parse(text).dump()) << text;
    }
}

TEST(SmallJson, RefusesWhatTheLibraryRefuses) {
    for (const std::string text :
         {"", " ", "{", "}", "[1", "[1,]", R"({"a"})", R"({"a":})", "1 2", "nul", "\"\xff\"",
          "1e999", "\"x", "{}x", R"({a:1})", R"(["a":1])"}) {
        EXPECT_TRUE(Json::parse(text, nullptr, false).is_discarded()) << text;
        const auto read = parse_small_json(text);
        ASSERT_FALSE(read) << text;
        EXPECT_EQ(read.error().why.substr(0, 10), "not JSON: ") << text;
    }
}

TEST(SmallJson, HoldsSoManyValuesAndNoMore) {
    EXPECT_TRUE(parse_small_json("[1,2,3]", 5));  // with its two ends
    EXPECT_EQ(parse_small_json("[1,2,3,4]", 5).error().why, "has more than 5 keys and values");
    EXPECT_TRUE(parse_small_json(R"({"a":1})", 4));
    EXPECT_FALSE(parse_small_json(R"({"a":1})", 3));
}

TEST(SmallJson, NestsSoDeepAndNoDeeper) {
    EXPECT_TRUE(parse_small_json("[[[[[[[[1]]]]]]]]"));
    EXPECT_TRUE(parse_small_json("[[[[[[[[[]]]]]]]]]"));
    for (const std::string text : {"[[[[[[[[[1]]]]]]]]]", "[[[[[[[[[[]]]]]]]]]]"})
        EXPECT_EQ(parse_small_json(text).error().why, "nests deeper than 8 levels") << text;
}

// It stops where there is too much, and does not look at what comes after.
TEST(SmallJson, StopsWhereItIsTooLarge) {
    EXPECT_EQ(parse_small_json("[[[[[[[[[[ no JSON").error().why, "nests deeper than 8 levels");
    EXPECT_EQ(parse_small_json("[1,2,3,4, no JSON", 4).error().why,
              "has more than 4 keys and values");
}

}  // namespace
}  // namespace scipd::sim
