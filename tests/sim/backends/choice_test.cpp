// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/choice.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "tests/support/scene_builder.h"

namespace scipd::sim {
namespace {

using std::chrono::milliseconds;

/// Answers the same range for every beam, and takes its time for each pose, by a clock that is
/// turned by hand.
class Paced final : public RangeBackend {
  public:
    Paced(std::string_view name, Time& clock, Time first, Time later, float range_m)
        : RangeBackend(SceneBuilder().add(Sphere{1.0}, {}).build()),
          name_(name),
          clock_(clock),
          takes_(first),
          later_(later),
          range_m_(range_m) {}

    [[nodiscard]] std::string_view name() const { return name_; }
    [[nodiscard]] int most_poses() const { return most_poses_; }
    [[nodiscard]] int casts() const { return casts_; }

  private:
    void do_move(ModelId, const Pose&) override {}
    void do_cast(const Fan& fan, std::span<Hit> hits) override {
        const auto poses = static_cast<int>(fan.world_from_sensor.size());
        most_poses_ = std::max(most_poses_, poses);
        ++casts_;
        clock_ += poses * std::exchange(takes_, later_);
        for (Hit& hit : hits)
            hit = {.range_m = range_m_, .object = 0};
    }

    std::string_view name_;
    Time& clock_;
    Time takes_;
    Time later_;
    float range_m_;
    int most_poses_ = 0;  ///< in one cast
    int casts_ = 0;
};

class Choosing : public testing::Test {
  protected:
    void add(std::string_view name, Time later, float range_m = 1.0F, Time first = {}) {
        paced_.push_back(std::make_unique<Paced>(name, clock_, first, later, range_m));
    }
    Choice chosen() {
        std::vector<Contender> contenders;
        for (const auto& paced : paced_)
            contenders.push_back({paced->name(), paced.get()});
        const auto clock = [this] { return clock_; };
        return choose(contenders, fans_, clock, limits_);
    }
    /// A pose for each of so many beams.
    void sweep_with_poses(std::size_t poses) {
        directions_.assign(poses, {1, 0, 0});
        pose_.clear();
        for (std::size_t i = 0; i < poses; ++i)
            pose_.push_back({{0.001 * double(i), 0, 0}, {1, 0, 0, 0}});
        fans_ = {{directions_, pose_}, {directions_, pose_}};
    }

    Time clock_{};
    ChoiceLimits limits_;
    std::vector<std::unique_ptr<Paced>> paced_;
    std::vector<glm::vec3> directions_{{1, 0, 0}, {0, 1, 0}};
    std::vector<Pose> pose_ = std::vector<Pose>(1);
    std::vector<Fan> fans_{{directions_, pose_}, {directions_, pose_}};
};

TEST_F(Choosing, TakesTheFastestAndTellsWhatAllTook) {
    add("rays", milliseconds(3));
    add("depth", milliseconds(2));
    add("third", milliseconds(4));
    const Choice choice = chosen();
    EXPECT_EQ(choice.reason, "2.000 ms per scan; rays: 3.000 ms; third: 4.000 ms");
    EXPECT_EQ(choice.contender, 1U);
}

TEST_F(Choosing, KeepsTheYardstickWhereNothingIsClearlyFaster) {
    add("rays", milliseconds(20));
    add("depth", milliseconds(19));
    EXPECT_EQ(chosen().contender, 0U);
}

TEST_F(Choosing, DoesNotCountWhatWarmingUpTakes) {
    add("rays", milliseconds(3));
    add("depth", milliseconds(2), 1.0F, milliseconds(500));
    EXPECT_EQ(chosen().contender, 1U);
}

TEST_F(Choosing, WaitsForNobodyWhoIsHopeless) {
    add("rays", milliseconds(1));
    add("depth", milliseconds(1000));
    EXPECT_EQ(chosen().contender, 0U);
    EXPECT_LT(clock_, milliseconds(1100));  // one fan once, beside warming up
}

TEST_F(Choosing, RefusesWhatDisagreesWithTheYardstick) {
    add("rays", milliseconds(3));
    add("depth", milliseconds(1), 1.01F);
    const Choice choice = chosen();
    EXPECT_EQ(choice.reason,
              "3.000 ms per scan; depth: 1.000 ms, but differs in 100.0 % of the beams");
    EXPECT_EQ(choice.contender, 0U);
}

TEST_F(Choosing, CastsTheWholeOfASweepThatIsQuick) {
    sweep_with_poses(1081);
    add("rays", std::chrono::microseconds(1));
    add("depth", std::chrono::nanoseconds(500));
    const Choice choice = chosen();
    EXPECT_EQ(choice.reason, "0.540 ms per scan; rays: 1.081 ms");
    EXPECT_EQ(choice.contender, 1U);
    EXPECT_EQ(paced_[0]->most_poses(), 1081);
}

// A picture for each of 25344 beams would take a quarter of a minute.
TEST_F(Choosing, CastsAShareOfASweepThatTakesLongAndSaysSo) {
    sweep_with_poses(176 * 144);
    add("rays", std::chrono::microseconds(1));
    add("depth", std::chrono::microseconds(100));
    const Choice choice = chosen();
    EXPECT_EQ(choice.contender, 0U);
    EXPECT_EQ(choice.reason,
              "0.256 ms per scan, measured on 256 of its 25344 poses; depth: 25.600 ms");
    EXPECT_EQ(paced_[1]->most_poses(), 256);
    EXPECT_LT(clock_, milliseconds(150));
}

TEST_F(Choosing, KeepsToItsBudgetWhereAllAreSlow) {
    sweep_with_poses(100'000);
    add("rays", milliseconds(2), 1.0F, milliseconds(2));
    add("depth", milliseconds(1), 1.0F, milliseconds(1));
    const Choice choice = chosen();
    EXPECT_EQ(choice.contender, 1U);
    EXPECT_THAT(choice.reason,
                testing::HasSubstr(" per scan, measured on 16 of its 100000 poses; rays: "));
    EXPECT_LT(clock_, limits_.budget + milliseconds(100));
}

TEST_F(Choosing, CutsNoSweepForWhatIsDoneOnce) {
    sweep_with_poses(1000);
    add("rays", std::chrono::microseconds(1), 1.0F, milliseconds(20));
    add("depth", std::chrono::microseconds(2), 1.0F, milliseconds(10));
    EXPECT_EQ(chosen().reason, "1.000 ms per scan; depth: 2.000 ms");
}

// Whatever one picture takes, there is something to tell by.
TEST_F(Choosing, ComparesOneFanEvenIfThatTakesAllTheTime) {
    add("rays", std::chrono::seconds(3), 1.0F, std::chrono::seconds(3));
    add("depth", std::chrono::seconds(1), 1.0F, std::chrono::seconds(2));
    const Choice choice = chosen();
    EXPECT_EQ(choice.contender, 1U);
    EXPECT_EQ(choice.reason, "1000.000 ms per scan; rays: 3000.000 ms");
    EXPECT_EQ(clock_, std::chrono::seconds(3 + 2 + 3 + 1));
}

TEST_F(Choosing, EndsWithTheCastThatIsUnderWay) {
    sweep_with_poses(1000);
    add("rays", milliseconds(1));
    add("depth", milliseconds(1));
    limits_.ended = [&] { return paced_[0]->casts() == 1; };
    EXPECT_EQ(chosen().contender, 0U);
    EXPECT_EQ(paced_[0]->casts(), 1);
    EXPECT_EQ(paced_[1]->casts(), 0);
}

}  // namespace
}  // namespace scipd::sim
