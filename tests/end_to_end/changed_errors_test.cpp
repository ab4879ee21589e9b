// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How well a scanner reads changes while a driver streams, by the control API and by a reload. The
// driver notices nothing but the errors.
#include <algorithm>
#include <csignal>
#include <cstdint>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/end_to_end/in_square_room.h"
#include "tests/support/child.h"
#include "tests/support/control_request.h"

namespace scipd::tests {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class ChangedErrors : public testing::Test {
  protected:
    ChangedErrors()
        : daemon_(directory_, {"--config", write("accuracy: ideal"), "--threads", "1"}),
          wire_(ScannerWire::tcp(daemon_.port())) {
        EXPECT_EQ(wire_.ask(stream_of_one_beam), "00");
        stamp_ms_ = wire_.next_scan().stamp_ms;
    }

    std::string write(const std::string& errors) {
        return directory_.write("rig.yaml",
                                "scene: " + scene("square_room.sdf").string() +
                                    "\nrobots: {r: {sensors: {s: {model: UST-10LX, mount: {xyz: "
                                    "[0, 0, 0.3]}, tcp: \"127.0.0.1:0\", " +
                                    errors + "}}}}\n");
    }

    ControlAnswer patch(const json& errors, const std::string& sensor = "r/s") const {
        return control_request(daemon_.control(), "PATCH", "/sensors/" + sensor, errors.dump());
    }
    [[nodiscard]] json errors() const {
        return control_get(daemon_.control(), "/sensors/r/s")["errors"];
    }

    /// What the beam ahead reads in so many scans, none of which is missing.
    std::vector<std::uint32_t> read(int scans) {
        std::vector<std::uint32_t> distances;
        for (int i = 0; i < scans; ++i) {
            const auto scan = wire_.next_scan();
            EXPECT_EQ(turns_between(stamp_ms_, scan.stamp_ms), 1);
            stamp_ms_ = scan.stamp_ms;
            distances.push_back(scan.distances_mm.front());
        }
        return distances;
    }
    /// One that was under way may still come.
    void skip_a_few() { (void)read(3); }

    static std::uint32_t spread(const std::vector<std::uint32_t>& distances) {
        const auto [least, most] = std::ranges::minmax(distances);
        return most - least;
    }

    TempDir directory_;
    DaemonProcess daemon_;
    ScannerWire wire_;
    std::uint32_t stamp_ms_ = 0;
};

TEST_F(ChangedErrors, AreThoseOfTheNextScans) {
    EXPECT_EQ(spread(read(20)), 0U);
    EXPECT_EQ(patch({{"accuracy", "sensor"}, {"noise", 1}}).status, 200);
    skip_a_few();
    const std::uint32_t usual = spread(read(40));
    EXPECT_GT(usual, 8U);
    EXPECT_EQ(patch({{"noise", 20}}).status, 200);
    skip_a_few();
    EXPECT_GT(spread(read(40)), 8 * usual);
    EXPECT_EQ(patch({{"noise", 0}, {"bias", {{{"range_m", 1}, {"bias_m", 0.3}}}}}).status, 200);
    skip_a_few();
    EXPECT_THAT(read(5), testing::Each(3300U));
    EXPECT_EQ(errors(), json({{"accuracy", "sensor"},
                              {"noise", 0.0},
                              {"bias", {{{"range_m", 1.0}, {"bias_m", 0.3}}}},
                              {"interference", false}}));
}

TEST_F(ChangedErrors, FollowAReloadAsWell) {
    EXPECT_EQ(spread(read(20)), 0U);
    write("accuracy: sensor, noise: 3");
    daemon_.signal(SIGHUP);
    ASSERT_TRUE(eventually([&] {
        (void)read(1);
        return errors()["noise"] == 3.0;
    }));
    skip_a_few();
    EXPECT_GT(spread(read(40)), 25U);
}

TEST_F(ChangedErrors, AreSetByScipctl) {
    const auto set = [&](std::vector<std::string> words) {
        words.insert(words.begin(), {SCIPCTL, "--control", daemon_.control(), "sensor", "set"});
        return run(words);
    };
    const Outcome done = set({"r/s", "accuracy=sensor", "noise=2", "bias=none"});
    EXPECT_EQ(done.exit_code, 0) << done.err;
    EXPECT_EQ(json::parse(done.out), errors());
    EXPECT_EQ(errors()["noise"], 2.0);
    EXPECT_THAT(set({"r/s", "noise=loud"}).err, HasSubstr("must be a number from 0 to 100"));
    EXPECT_THAT(set({"r/s", "noise"}).err, HasSubstr("accuracy=ideal or noise=2"));
    EXPECT_THAT(set({"r/other", "noise=2"}).err, HasSubstr("r/s"));
}

TEST_F(ChangedErrors, AreRefusedWithWhatIsRight) {
    const auto said = [&](const json& errors) {
        const ControlAnswer answer = patch(errors);
        EXPECT_EQ(answer.status, 400) << answer.body;
        return answer.body;
    };
    EXPECT_THAT(said({{"accuracy", "best"}}), HasSubstr("must be ideal, sensor or material"));
    EXPECT_THAT(said({{"noise", -1}}), HasSubstr("must be a number from 0 to 100"));
    EXPECT_THAT(said({{"noise", "loud"}}), HasSubstr("must be a number from 0 to 100"));
    EXPECT_THAT(said({{"bias", "some"}}), HasSubstr("none"));
    EXPECT_THAT(said({{"interference", 1}}), HasSubstr("must be true or false"));
    EXPECT_THAT(said({{"model", "URG-04LX"}}), HasSubstr("does not change while scipd runs"));
    EXPECT_THAT(said(json::object()), HasSubstr("the body must be a JSON object"));
    EXPECT_EQ(patch({{"noise", 2}}, "r/other").status, 404);
    EXPECT_EQ(errors()["accuracy"], "ideal");
    EXPECT_EQ(spread(read(5)), 0U);
}

}  // namespace
}  // namespace scipd::tests
