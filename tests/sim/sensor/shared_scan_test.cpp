// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/shared_scan.h"

#include <thread>
#include <utility>

#include <gtest/gtest.h>

#include "sim/recycled.h"

namespace scipd::sim {
namespace {

constexpr std::size_t beams = 1081;

Scan scan_of(std::size_t count) {
    Scan scan;
    scan.hits = Recycled<Hit>::take(count);
    return scan;
}

TEST(SharedScans, LeaveTheirArraysToTheNext) {
    SharedScan first = share(scan_of(beams));
    const Hit* const memory = first->hits.data();
    const SharedScan other = share(scan_of(beams));
    EXPECT_NE(other->hits.data(), memory) << "somebody still has it";
    const SharedScan held = first;
    first.reset();
    EXPECT_NE(share(scan_of(beams))->hits.data(), memory);
    EXPECT_EQ(held->hits.size(), beams);
}

TEST(SharedScans, LeaveThemWhenNobodyHasThem) {
    const Hit* memory = nullptr;
    {
        const SharedScan scan = share(scan_of(beams));
        memory = scan->hits.data();
    }
    const Scan next = scan_of(beams - 100);
    EXPECT_EQ(next.hits.data(), memory);
    EXPECT_EQ(next.hits.size(), beams - 100);
}

// One pose must not come to hold the memory of a thousand, and a ranger's scan not a camera's.
TEST(Recycled, ArraysAreNotMuchLargerThanNeeded) {
    Recycled<int>::give(std::vector<int>(10'000));
    EXPECT_LT(Recycled<int>::take(100).capacity(), 1000U);
    EXPECT_GE(Recycled<int>::take(9'000).capacity(), 10'000U);
    Recycled<char>::give(std::vector<char>(50'000'000));
    EXPECT_LT(Recycled<char>::take(30'000'000).capacity(), 50'000'000U);
}

TEST(Recycled, ArraysStayOnTheThreadThatGaveThem) {
    std::vector<double> array(1000);
    const double* const memory = array.data();
    Recycled<double>::give(std::move(array));
    std::thread([&] { EXPECT_NE(Recycled<double>::take(1000).data(), memory); }).join();
    EXPECT_EQ(Recycled<double>::take(1000).data(), memory);
}

}  // namespace
}  // namespace scipd::sim
