// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// scipctl scene medium against the real routes.
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/support/child.h"
#include "tests/tools/scipctl/control_stand_in.h"

namespace scipd::tests {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class ScipctlMedium : public testing::Test {
  protected:
    Outcome medium(std::vector<std::string> words) const {
        words.insert(words.begin(), {SCIPCTL, "--control", daemon_.socket(), "scene", "medium"});
        return run(words);
    }
    void expect_done(const std::vector<std::string>& words) const {
        const Outcome outcome = medium(words);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(outcome.out, "");
    }
    std::string refused(const std::vector<std::string>& words, int exit_code = 2) const {
        const Outcome outcome = medium(words);
        EXPECT_EQ(outcome.exit_code, exit_code) << outcome.out;
        return outcome.err;
    }
    json list() const { return json::parse(medium({"--json"}).out); }

    const ControlStandIn daemon_{{"rescue"}};
};

TEST_F(ScipctlMedium, FillsTheAirAndListsIt) {
    EXPECT_EQ(medium({}).out, "the air is clear\n");
    expect_done({"rain", "--rate", "10"});
    expect_done({"fog", "--visibility", "20", "--box", "3,2,2.5,-1,0,0", "--name", "mist"});
    expect_done({"custom", "--extinction", "0.5", "--returns", "2"});
    EXPECT_EQ(medium({}).out,
              "NAME    KIND    HOW MUCH                                                 WHERE\n"
              "rain    rain    10 mm an hour                                            "
              "everywhere\n"
              "mist    fog     visibility 20 m                                          "
              "-1,0,0 to 3,2,2.5\n"
              "custom  custom  extinction 0.5 a metre, returns 2 a metre, brightness 0  "
              "everywhere\n");
    EXPECT_EQ(list()[1], json::parse(R"({"kind":"fog","name":"mist","visibility_m":20,
        "box":{"from":[-1,0,0],"to":[3,2,2.5]}})"));
}

TEST_F(ScipctlMedium, ReplacesAndTakesAwayByName) {
    expect_done({"fog", "--visibility", "20"});
    expect_done({"rain", "--rate", "10"});
    expect_done({"fog", "--visibility", "5"});
    ASSERT_EQ(list().size(), 2U);
    EXPECT_EQ(list()[0]["visibility_m"], 5.0);
    expect_done({"none", "--name", "fog"});
    ASSERT_EQ(list().size(), 1U);
    EXPECT_EQ(list()[0]["kind"], "rain");
    EXPECT_EQ(refused({"none", "--name", "fog"}, 1),
              "scipctl: there is no medium \"fog\"; scipctl scene medium lists them\n");
    expect_done({"snow", "--rate", "1"});
    expect_done({"none"});
    EXPECT_EQ(list(), json::array());
}

TEST_F(ScipctlMedium, SaysWhatIsWrong) {
    EXPECT_EQ(refused({"fog"}), "scipctl: fog needs --visibility\n");
    EXPECT_EQ(refused({"fog", "--visibility", "5", "--rate", "3"}),
              "scipctl: fog has no --rate; it has --visibility\n");
    EXPECT_THAT(refused({"fog", "--visibility", "0"}), HasSubstr("must be a number from 0.5 to"));
    EXPECT_THAT(refused({"rain", "--rate", "nan"}), HasSubstr("must be a number from 0 to 500"));
    EXPECT_THAT(refused({"mud"}), HasSubstr("mud"));
    EXPECT_THAT(refused({"fog", "--visibility", "5", "--box", "1,2,3"}), HasSubstr("--box"));
    EXPECT_EQ(refused({"fog", "20"}),
              "scipctl: unexpected argument '20'; did you mean fog --visibility 20?\n");
    EXPECT_EQ(refused({"rain", "4"}),
              "scipctl: unexpected argument '4'; did you mean rain --rate 4?\n");
    EXPECT_EQ(refused({"none", "4"}), "scipctl: unexpected argument '4'\n");
    EXPECT_EQ(refused({"--rate", "3"}),
              "scipctl: name the medium before its options, such as: fog --visibility 20\n");
    EXPECT_EQ(refused({"--name", "mist"}),
              "scipctl: name the kind of medium, such as: fog --visibility 20 --name mist\n");
    EXPECT_THAT(refused({"fog", "--visibility", "5", "--box", "0,0,0,1,0,1"}, 1),
                HasSubstr("must go from the lowest corner to the highest"));
    EXPECT_EQ(list(), json::array());
}

}  // namespace
}  // namespace scipd::tests
