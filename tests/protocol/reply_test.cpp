// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/reply.h"

#include <vector>

#include <gtest/gtest.h>

namespace scipd::protocol {
namespace {

TEST(Reply, WithoutDataIsEchoStatusAndAnEmptyLine) {
    EXPECT_EQ(Reply("BM", status::ok).finish(), "BM\n00P\n\n");
    EXPECT_EQ(Reply("CR00", Status("04")).finish(), "CR00\n04T\n\n");
    EXPECT_EQ(Reply("TM1;a b", status::denied).finish(), "TM1;a b\n10Q\n\n");
}

TEST(Reply, LinesHaveTheirSums) {
    EXPECT_EQ(Reply("TM1", status::ok).line("<Sfk").finish(),
              "TM1\n00P\n<SfkP\n\n");  // recorded UXM-30LX-E
}

TEST(Reply, TheSemicolonOfAnEntryIsNotInItsSum) {
    EXPECT_EQ(Reply("PP", status::ok).entry("DMIN", 20).entry("SCSP", "2400").finish(),
              "PP\n00P\nDMIN:20;4\nSCSP:2400;i\n\n");
}

TEST(Reply, HoldsABlockOfData) {
    const std::vector<std::uint32_t> values = {1234, 4095};
    EXPECT_EQ(Reply("GS00000001", status::ok).line("0000").data(values, 2).finish(),
              "GS00000001\n00P\n00000\nCBooS\n\n");
}

}  // namespace
}  // namespace scipd::protocol
