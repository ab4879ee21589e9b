// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/api/object_text.h"

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace scipd::daemon {
namespace {

using nlohmann::json;

std::string text_of_rounded(double value) {
    std::string text;
    append_rounded(text, value);
    return text;
}

TEST(ObjectText, IsAnObjectOfAllThatWasAdded) {
    ObjectText text(Json{{"name", "a \"quoted\" one"}});
    text.add("pose", Json{{"x", 1.5}});
    text.add_list("list", std::vector{1, 2, 3},
                  [](std::string& list, int i) { list += std::to_string(i); });
    text.add_list("none", std::vector<int>{}, [](std::string& list, int) { list += "?"; });
    EXPECT_EQ(std::move(text).finish(),
              R"({"name":"a \"quoted\" one","pose":{"x":1.5},"list":[1,2,3],"none":[]})");
    ObjectText alone(Json::object());
    alone.add("x", 1);
    EXPECT_EQ(std::move(alone).finish(), R"({"x":1})");
}

TEST(ObjectText, HasNumbersAsTheyAreWrittenEverywhere) {
    EXPECT_EQ(text_of_rounded(0.0), "0.0");
    EXPECT_EQ(text_of_rounded(12.0), "12.0");
    EXPECT_EQ(text_of_rounded(4.5), "4.5");
    EXPECT_EQ(text_of_rounded(0.000001), "0.000001");
    EXPECT_EQ(text_of_rounded(0.9999996), "1.0");
    EXPECT_EQ(text_of_rounded(10.050607), "10.050607");
    EXPECT_EQ(text_of_rounded(-0.25), "-0.25");
    EXPECT_EQ(text_of_rounded(2e12), "2000000000000.0");
    EXPECT_EQ(text_of_rounded(std::numeric_limits<double>::infinity()), "null");
    EXPECT_EQ(text_of_rounded(std::numeric_limits<double>::quiet_NaN()), "null");
}

TEST(ObjectText, HasPosesAsDocumentsHaveThem) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> values(-100.0, 100.0);
    const auto next = [&] { return values(random); };
    for (int i = 0; i < 1000; ++i) {
        sim::Pose pose{{next(), next(), 1e-9 * next()}, {next(), next(), next(), next()}};
        if (i == 0) pose = {};
        const double time_s = 1e4 * next();
        std::string text;
        append_timed_pose(text, time_s, pose);
        json expected(pose_document(pose));
        expected["time_s"] = time_s;
        ASSERT_EQ(json::parse(text), expected) << text;
    }
    std::string text;
    append_timed_pose(text, 2.0, {{1, 0, -1.5}, {1, 0, 0, 0}});
    EXPECT_EQ(text, R"({"time_s":2.0,"xyz":[1.0,0.0,-1.5],"q":[0.0,0.0,0.0,1.0]})");
}

// By another reader of numbers: the very double that rounding gives.
TEST(ObjectText, LosesNothingOfARoundedNumber) {
    std::mt19937 random(7);
    for (const double most : {1e-5, 0.01, 1.0, 60.0, 1e4, 1e8, 1e10}) {
        std::uniform_real_distribution<double> values(-most, most);
        for (int i = 0; i < 20'000; ++i) {
            const double value = i % 2 == 0 ? values(random) : float(values(random));
            ASSERT_EQ(json::parse(text_of_rounded(value)).get<double>(), rounded(value)) << value;
        }
    }
}

}  // namespace
}  // namespace scipd::daemon
