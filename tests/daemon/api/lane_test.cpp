// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/api/lane.h"

#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace scipd::daemon {
namespace {

class LaneTest : public testing::Test {
  protected:
    /// How many of so many calls get in.
    std::size_t post(Lane& lane, std::size_t calls, std::size_t bytes = 0) {
        std::size_t in = 0;
        for (std::size_t i = 0; i < calls; ++i) {
            if (lane.loses_next()) continue;
            lane.post(bytes, [this] { ++called_; });
            ++in;
        }
        return in;
    }
    void take_all() {
        for (const auto& call : std::exchange(waiting_, {}))
            call();
    }

    std::vector<Lane::Call> waiting_;
    Lane::Way way_ = [this](Lane::Call call) { waiting_.push_back(std::move(call)); };
    std::size_t called_ = 0;
};

TEST_F(LaneTest, HasOnlySoMuchWait) {
    Lane lane(way_, 5);
    EXPECT_EQ(post(lane, 8), 5U);
    EXPECT_EQ(lane.lost(), 3U);
    Lane copy = lane;
    EXPECT_EQ(post(copy, 1), 0U) << "it is the same";
    take_all();
    EXPECT_EQ(called_, 5U);
    EXPECT_EQ(post(lane, 8), 5U);
    EXPECT_EQ(lane.lost(), 7U);
}

TEST_F(LaneTest, HasOneOfEachWaitWhereTheyAreLarge) {
    const auto load = std::make_shared<Lane::Load::element_type>(0);
    Lane pictures(way_, 16, load);
    Lane others(way_, 16, load);
    constexpr std::size_t large = 20'000'000;
    EXPECT_EQ(post(pictures, 10, large), 4U);
    EXPECT_EQ(post(others, 10, large), 1U);
    take_all();
    EXPECT_EQ(*load, 0U);
    EXPECT_EQ(post(others, 10, large), 4U);
}

}  // namespace
}  // namespace scipd::daemon
