// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/device/pace.h"

#include <chrono>
#include <optional>
#include <string>

#include <gmock/gmock.h>

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

constexpr sim::Time period = 25ms;

class PaceTest : public testing::Test {
  protected:
    /// So many sweeps, each begun when the one before is done and its time has come, or late.
    void cast(int sweeps, sim::Time takes, const char* backend = "depth") {
        for (int i = 0; i < sweeps; ++i) {
            const auto said = pace_.add({.backend = backend,
                                         .period = period,
                                         .many_poses = many_poses_,
                                         .due = now_ - late_,
                                         .begin = now_,
                                         .end = now_ + takes});
            now_ += std::max(period, takes);
            if (!said) continue;
            EXPECT_FALSE(said_) << "once is enough";
            said_ = said;
        }
    }

    Pace pace_;
    sim::Time now_ = 1h;
    bool many_poses_ = true;
    sim::Time late_{};
    std::optional<std::string> said_;
};

TEST_F(PaceTest, IsToldOnceWhereSweepsTakeLongerThanTheyLast) {
    cast(1000, 31200us);
    EXPECT_EQ(said_,
              "depth takes 31.2 ms to cast a sweep, of which one is due every 25.0 ms, so that "
              "some are lost; what helps: fewer poses a sweep (motion: N) or rays (backend: auto "
              "or embree)");
}

TEST_F(PaceTest, SaysNothingOfOneThatKeepsUpForHours) {
    cast(500'000, 24900us);
    EXPECT_FALSE(said_);
}

TEST_F(PaceTest, IsToldWhereManyTogetherAreTooSlow) {
    late_ = 500ms;
    cast(1000, 15ms);
    EXPECT_EQ(said_,
              "depth takes 15.0 ms to cast a sweep, of which one is due every 25.0 ms, beside all "
              "else that this machine does, so that some are lost; what helps: fewer poses a sweep "
              "(motion: N) or rays (backend: auto or embree)");
}

TEST_F(PaceTest, SaysNothingOfOneThatIsLateBecauseOfOthers) {
    late_ = 500ms;
    cast(10'000, 1ms);
    late_ = 20ms;
    cast(10'000, 15ms);
    EXPECT_FALSE(said_);
}

TEST_F(PaceTest, SaysNothingOfABusyMoment) {
    cast(1000, 1ms);
    cast(20, 100ms);  // two seconds
    cast(1000, 1ms);
    EXPECT_FALSE(said_);
}

TEST_F(PaceTest, SaysNothingOfAFewReadingsFarApart) {
    for (int i = 0; i < 7; ++i) {
        cast(1, 300ms);
        now_ += 1min;
    }
    EXPECT_FALSE(said_);
}

TEST_F(PaceTest, BeginsAnewWithAnotherBackend) {
    for (int i = 0; i < 10; ++i) {
        cast(40, 100ms, "depth");
        cast(40, 100ms, "reference");
    }
    EXPECT_FALSE(said_) << "four seconds each";
}

TEST_F(PaceTest, NamesWhatHelps) {
    cast(1000, 50ms, "embree");
    ASSERT_TRUE(said_);
    EXPECT_THAT(*said_, testing::EndsWith("what helps: fewer poses a sweep (motion: N)"));
}

TEST_F(PaceTest, NamesNoPosesWhereThereIsOne) {
    many_poses_ = false;
    cast(1000, 50ms, "depth");
    ASSERT_TRUE(said_);
    EXPECT_THAT(*said_, testing::EndsWith("what helps: rays (backend: auto or embree)"));
}

}  // namespace
}  // namespace scipd::daemon
