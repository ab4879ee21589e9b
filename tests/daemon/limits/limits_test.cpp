// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/limits/limits.h"

#include <set>

#include <gtest/gtest.h>

namespace scipd::daemon {
namespace {

TEST(Limits, HasARowOfItsOwnForEachLimit) {
    std::set<std::string_view> keys;
    for (const LimitRow& row : limit_table) {
        keys.insert(row.key);
        EXPECT_LE(row.least, row.usual) << row.key;
        EXPECT_LE(row.usual, row.most) << row.key;
        EXPECT_NE(row.beyond.find('@'), std::string_view::npos) << row.key;
    }
    EXPECT_EQ(keys.size(), limit_table.size());
    EXPECT_EQ(limit_table[place_of(Limit::scip_line_bytes)].key, "scip_line_bytes");
    EXPECT_EQ(limit_table[place_of(Limit::http_body_bytes)].key, "http_body_bytes");
    EXPECT_EQ(limit_table[place_of(Limit::poses_per_s)].key, "poses_per_s");
}

TEST(Limits, CountsEachLimitAndSaysWhatAllowsMore) {
    Limits limits;
    LimitValues values;
    values[Limit::http_body_bytes] = 10;
    limits.set(values);
    EXPECT_EQ(limits[Limit::http_body_bytes], 10U);
    EXPECT_EQ(limits.refuse(Limit::http_body_bytes, "somebody"),
              "the body or message is larger than 10 bytes; http_body_bytes under limits in the "
              "configuration "
              "allows more");
    limits.refuse(Limit::http_body_bytes, "somebody");
    EXPECT_EQ(limits.refused(Limit::http_body_bytes), 2U);
    EXPECT_EQ(limits.refused(Limit::poses_per_s), 0U);
}

}  // namespace
}  // namespace scipd::daemon
