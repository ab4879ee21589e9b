// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/link/outbox.h"

#include <chrono>
#include <string>

#include <gtest/gtest.h>

namespace scipd::daemon {
namespace {

using Kind = protocol::Send::Kind;

protocol::Send scan_of(std::size_t bytes) {
    return {std::string(bytes, 's'), Kind::scan};
}

constexpr std::size_t capacity = 1000;
constexpr sim::Time now{1};

class OutboxTest : public testing::Test {
  protected:
    [[nodiscard]] static Outbox with(const LinkConfig& link) {
        return Outbox(LinkModel(link, {}), capacity);
    }
    std::string pop() {
        auto piece = outbox_.line().take(now);
        return piece ? piece->bytes : "nothing";
    }

    Outbox outbox_ = with({});
};

TEST_F(OutboxTest, HandsOutInOrder) {
    EXPECT_TRUE(outbox_.line().empty());
    EXPECT_TRUE(outbox_.push({"first", Kind::reply}, now));
    EXPECT_TRUE(outbox_.push({"second", Kind::scan}, now));
    EXPECT_EQ(pop(), "first");
    EXPECT_EQ(pop(), "second");
    EXPECT_TRUE(outbox_.line().empty());
}

TEST_F(OutboxTest, DropsScansWholeWhereThereIsNoRoom) {
    EXPECT_TRUE(outbox_.push(scan_of(capacity - 10), now));
    EXPECT_FALSE(outbox_.push(scan_of(11), now));
    EXPECT_TRUE(outbox_.push(scan_of(10), now));
    EXPECT_FALSE(outbox_.push(scan_of(1), now));
    EXPECT_EQ(pop().size(), capacity - 10);
    EXPECT_EQ(pop().size(), 10U);
    EXPECT_TRUE(outbox_.line().empty());
    // Room that was made is room again.
    EXPECT_TRUE(outbox_.push(scan_of(capacity), now));
}

TEST_F(OutboxTest, HasRoomForAnyScanThatIsAlone) {
    EXPECT_TRUE(outbox_.push(scan_of(2 * capacity), now));
    EXPECT_FALSE(outbox_.push(scan_of(1), now));
}

TEST_F(OutboxTest, NeverDropsReplies) {
    EXPECT_TRUE(outbox_.push(scan_of(capacity), now));
    EXPECT_TRUE(outbox_.full());
    EXPECT_TRUE(outbox_.push({"QT\n00P\n\n", Kind::reply}, now));
    (void)pop();
    EXPECT_FALSE(outbox_.full());
    EXPECT_EQ(pop(), "QT\n00P\n\n");
}

TEST_F(OutboxTest, CountsWhatIsUnderWayOnTheLink) {
    outbox_ = with({.latency = std::chrono::seconds(1), .coalesce = std::chrono::seconds(1)});
    EXPECT_TRUE(outbox_.push(scan_of(capacity - 10), now));
    EXPECT_EQ(pop(), "nothing");
    EXPECT_FALSE(outbox_.push(scan_of(11), now));
    EXPECT_TRUE(outbox_.push(scan_of(10), now));
    EXPECT_TRUE(outbox_.full());
}

TEST_F(OutboxTest, ForgetsEverything) {
    EXPECT_TRUE(outbox_.push(scan_of(capacity), now));
    outbox_.line().clear();
    EXPECT_TRUE(outbox_.line().empty());
    EXPECT_FALSE(outbox_.full());
    EXPECT_TRUE(outbox_.push(scan_of(capacity), now));
}

}  // namespace
}  // namespace scipd::daemon
