// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Against the test vectors of the hash's authors (draft-eastlake-fnv, Test Vectors).
#include "sim/fnv1a.h"

#include <gtest/gtest.h>

namespace scipd::sim {
namespace {

TEST(Fnv1a, IsThatOfItsAuthorsIn32Bits) {
    EXPECT_EQ(fnv1a<std::uint32_t>(""), 0x811c9dc5U);
    EXPECT_EQ(fnv1a<std::uint32_t>("a"), 0xe40c292cU);
    EXPECT_EQ(fnv1a<std::uint32_t>("foobar"), 0xbf9cf968U);
}

TEST(Fnv1a, IsThatOfItsAuthorsIn64Bits) {
    EXPECT_EQ(fnv1a<std::uint64_t>(""), 0xcbf29ce484222325U);
    EXPECT_EQ(fnv1a<std::uint64_t>("a"), 0xaf63dc4c8601ec8cU);
    EXPECT_EQ(fnv1a<std::uint64_t>("foobar"), 0x85944171f73967e8U);
}

}  // namespace
}  // namespace scipd::sim
