// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/choice.h"

#include <chrono>
#include <stdexcept>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "tests/sim/backends/contract.h"

namespace scipd::sim {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;
using testing::StartsWith;

/// Answers the same range for every beam, and takes its time by a clock that is turned by hand.
class Paced final : public RangeBackend {
  public:
    Paced(Time& clock, Time first, Time later, float range_m)
        : RangeBackend(SceneBuilder().build()),
          clock_(clock),
          takes_(first),
          later_(later),
          range_m_(range_m) {}

    [[nodiscard]] std::string_view name() const override { return "paced"; }

  private:
    void do_move(ModelId, const Pose&) override {}
    void do_cast(const Fan&, std::span<Hit> hits) override {
        clock_ += std::exchange(takes_, later_);
        for (Hit& hit : hits)
            hit = {.range_m = range_m_, .object = 0};
    }

    Time& clock_;
    Time takes_;
    Time later_;
    float range_m_;
};

class Choosing : public testing::Test {
  protected:
    Contender contender(std::string name, Time later, float range_m = 1.0F, Time first = {}) {
        return {std::move(name), [this, later, range_m, first] {
                    return std::make_unique<Paced>(clock_, first, later, range_m);
                }};
    }
    Choice choose_among(const std::vector<Contender>& contenders) {
        return choose(contenders, fans_, [this] { return clock_; });
    }

    Time clock_{};
    std::vector<glm::vec3> directions_{{1, 0, 0}, {0, 1, 0}};
    std::vector<Pose> pose_ = std::vector<Pose>(1);
    std::vector<Fan> fans_{{directions_, pose_}, {directions_, pose_}};
};

TEST_F(Choosing, TakesTheFastestAndTellsWhatAllTook) {
    const Choice choice =
        choose_among({contender("rays", milliseconds(3)), contender("depth", milliseconds(2)),
                      contender("third", milliseconds(4))});
    EXPECT_EQ(choice.reason,
              "depth; rays takes 3.000 ms; depth takes 2.000 ms; third takes 4.000 ms");
    EXPECT_TRUE(choice.backend);
}

TEST_F(Choosing, KeepsTheYardstickWhereTheyAreEqual) {
    const Choice choice =
        choose_among({contender("rays", milliseconds(2)), contender("depth", milliseconds(2))});
    EXPECT_THAT(choice.reason, StartsWith("rays; "));
}

TEST_F(Choosing, DoesNotCountWhatWarmingUpTakes) {
    const Choice choice =
        choose_among({contender("rays", milliseconds(3)),
                      contender("depth", milliseconds(2), 1.0F, milliseconds(500))});
    EXPECT_THAT(choice.reason, StartsWith("depth; "));
}

TEST_F(Choosing, WaitsForNobodyWhoIsHopeless) {
    const Choice choice =
        choose_among({contender("rays", milliseconds(1)), contender("depth", milliseconds(1000))});
    EXPECT_THAT(choice.reason, StartsWith("rays; "));
    EXPECT_LT(clock_, milliseconds(5000));  // warming up and one more round of two fans
}

TEST_F(Choosing, RefusesWhatDisagreesWithTheYardstick) {
    const Choice choice = choose_among(
        {contender("rays", milliseconds(3), 1.0F), contender("depth", milliseconds(1), 1.01F)});
    EXPECT_EQ(
        choice.reason,
        "rays; rays takes 3.000 ms; depth takes 1.000 ms but differs in 100.0 % of the beams");
}

TEST_F(Choosing, TakesRaysWhereNothingElseIsToBeHad) {
    const Contender absent{"depth", []() -> std::unique_ptr<RangeBackend> {
                               throw std::runtime_error("there is no libEGL.so.1");
                           }};
    const Choice choice = choose_among({contender("rays", milliseconds(3)), absent});
    EXPECT_EQ(choice.reason, "rays; no depth: there is no libEGL.so.1");
    EXPECT_EQ(clock_, Time{});  // there is nothing to measure
    EXPECT_THROW(choose_among({absent}), std::runtime_error);
}

// Whichever it is on this machine, it casts.
TEST(ChooseBackend, ChoosesOneThatCasts) {
    const SharedScene scene = SceneBuilder().add(Box{{10, 10, 10}}, {}).build();
    const std::vector<glm::vec3> directions{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const std::vector<Pose> pose(1);
    const std::vector<Fan> fans{{directions, pose}};
    const Choice choice = choose_backend(scene, fans, [] {
        return std::chrono::duration_cast<Time>(
            std::chrono::steady_clock::now().time_since_epoch());
    });
    EXPECT_THAT(choice.reason, StartsWith(std::string(choice.backend->name()) + "; "));
    EXPECT_THAT(choice.reason, HasSubstr("depth"));
    std::vector<Hit> hits(3);
    choice.backend->cast(fans[0], hits);
    EXPECT_NEAR(hits[2].range_m, 5.0, 1e-4);
}

}  // namespace
}  // namespace scipd::sim
