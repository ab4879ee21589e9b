// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/choice.h"

#include <chrono>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/scene_builder.h"

namespace scipd::sim {
namespace {

using std::chrono::milliseconds;

/// Answers the same range for every beam, and takes its time by a clock that is turned by hand.
class Paced final : public RangeBackend {
  public:
    Paced(std::string_view name, Time& clock, Time first, Time later, float range_m)
        : RangeBackend(SceneBuilder().build()),
          name_(name),
          clock_(clock),
          takes_(first),
          later_(later),
          range_m_(range_m) {}

    [[nodiscard]] std::string_view name() const override { return name_; }

  private:
    void do_move(ModelId, const Pose&) override {}
    void do_cast(const Fan&, std::span<Hit> hits) override {
        clock_ += std::exchange(takes_, later_);
        for (Hit& hit : hits)
            hit = {.range_m = range_m_, .object = 0};
    }

    std::string_view name_;
    Time& clock_;
    Time takes_;
    Time later_;
    float range_m_;
};

class Choosing : public testing::Test {
  protected:
    void add(std::string_view name, Time later, float range_m = 1.0F, Time first = {}) {
        paced_.push_back(std::make_unique<Paced>(name, clock_, first, later, range_m));
    }
    Choice chosen() {
        std::vector<RangeBackend*> contenders;
        for (const auto& paced : paced_)
            contenders.push_back(paced.get());
        return choose(contenders, fans_, [this] { return clock_; });
    }

    Time clock_{};
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
    EXPECT_EQ(choice.reason, "rays takes 3.000 ms, depth takes 2.000 ms, third takes 4.000 ms");
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
    EXPECT_LT(clock_, milliseconds(5000));  // warming up and one more round of two fans
}

TEST_F(Choosing, RefusesWhatDisagreesWithTheYardstick) {
    add("rays", milliseconds(3));
    add("depth", milliseconds(1), 1.01F);
    const Choice choice = chosen();
    EXPECT_EQ(choice.reason,
              "rays takes 3.000 ms, depth takes 1.000 ms but differs in 100.0 % of the beams");
    EXPECT_EQ(choice.contender, 0U);
}

}  // namespace
}  // namespace scipd::sim
