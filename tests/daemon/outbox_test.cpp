// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/link/outbox.h"

#include <string>

#include <gtest/gtest.h>

namespace scipd::daemon {
namespace {

using Kind = protocol::Send::Kind;

protocol::Send scan_of(std::size_t bytes) {
    return {std::string(bytes, 's'), Kind::scan};
}

TEST(Outbox, HandsOutInOrder) {
    Outbox outbox;
    EXPECT_TRUE(outbox.empty());
    EXPECT_TRUE(outbox.push({"first", Kind::reply}));
    EXPECT_TRUE(outbox.push({"second", Kind::scan}));
    EXPECT_EQ(outbox.pop(), "first");
    EXPECT_EQ(outbox.pop(), "second");
    EXPECT_TRUE(outbox.empty());
}

TEST(Outbox, DropsScansWholeWhereThereIsNoRoom) {
    Outbox outbox;
    EXPECT_TRUE(outbox.push(scan_of(Outbox::capacity_bytes - 10)));
    EXPECT_FALSE(outbox.push(scan_of(11)));
    EXPECT_TRUE(outbox.push(scan_of(10)));
    EXPECT_FALSE(outbox.push(scan_of(1)));
    EXPECT_EQ(outbox.pop().size(), Outbox::capacity_bytes - 10);
    EXPECT_EQ(outbox.pop().size(), 10U);
    EXPECT_TRUE(outbox.empty());
    // Room that was made is room again.
    EXPECT_TRUE(outbox.push(scan_of(Outbox::capacity_bytes)));
}

TEST(Outbox, NeverDropsReplies) {
    Outbox outbox;
    EXPECT_TRUE(outbox.push(scan_of(Outbox::capacity_bytes)));
    EXPECT_TRUE(outbox.full());
    EXPECT_TRUE(outbox.push({"QT\n00P\n\n", Kind::reply}));
    (void)outbox.pop();
    EXPECT_FALSE(outbox.full());
    EXPECT_EQ(outbox.pop(), "QT\n00P\n\n");
}

TEST(Outbox, ForgetsEverything) {
    Outbox outbox;
    EXPECT_TRUE(outbox.push(scan_of(Outbox::capacity_bytes)));
    outbox.clear();
    EXPECT_TRUE(outbox.empty());
    EXPECT_FALSE(outbox.full());
    EXPECT_TRUE(outbox.push(scan_of(Outbox::capacity_bytes)));
}

}  // namespace
}  // namespace scipd::daemon
