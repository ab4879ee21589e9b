// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/poses/handover.h"

#include <atomic>
#include <thread>

#include <boost/asio/io_context.hpp>
#include <gtest/gtest.h>

namespace scipd::daemon {
namespace {

Heard message(std::size_t poses, double x_m = 0.0) {
    Heard heard;
    heard.poses.resize(poses);
    for (HeardPose& pose : heard.poses)
        pose.parent_from_child.translation_m.x = x_m;
    return heard;
}

TEST(Handover, CallsOnceForAllThatHasComeUntilAllIsTaken) {
    boost::asio::io_context io;
    Handover handover(io.get_executor(), false);
    int calls = 0;
    handover.hear(message(1));
    handover.open([&] { ++calls; });
    handover.hear(message(1));
    io.run();
    EXPECT_EQ(calls, 1);
    EXPECT_EQ(handover.take(100).size(), 2U);
    EXPECT_TRUE(handover.take(100).empty());
    handover.refuse("damaged");
    io.restart();
    io.run();
    EXPECT_EQ(calls, 2);
}

TEST(Handover, GivesSoManyPosesAtOnceOrOneMessage) {
    boost::asio::io_context io;
    Handover handover(io.get_executor(), false);
    handover.hear(message(500));
    handover.hear(message(60));
    handover.hear(message(60));
    handover.hear(message(60));
    EXPECT_EQ(handover.take(128).size(), 1U);
    EXPECT_EQ(handover.take(128).size(), 2U);
    EXPECT_EQ(handover.take(0).size(), 1U);
}

TEST(Handover, LosesTheOldestOnTheWallClock) {
    boost::asio::io_context io;
    Handover handover(io.get_executor(), false);
    for (int i = 0; i < 1500; ++i)
        handover.hear(message(1, i));
    EXPECT_EQ(handover.lost(), 500U);
    const auto first = handover.take(0);
    EXPECT_EQ(std::get<Heard>(first[0]).poses[0].parent_from_child.translation_m.x, 500.0);
}

TEST(Handover, LosesNothingInLockstep) {
    boost::asio::io_context io;
    Handover handover(io.get_executor(), true);
    constexpr int messages = 5000;
    std::thread bus([&] {
        for (int i = 0; i < messages; ++i)
            handover.hear(message(1, i));
    });
    for (int i = 0; i < messages;) {
        for (const auto& item : handover.take(0))
            EXPECT_EQ(std::get<Heard>(item).poses[0].parent_from_child.translation_m.x, i++);
    }
    bus.join();
    EXPECT_EQ(handover.lost(), 0U);
}

TEST(Handover, LetsABusGoThatWaits) {
    boost::asio::io_context io;
    Handover handover(io.get_executor(), true);
    std::atomic<int> said = 0;
    std::thread bus([&] {
        for (int i = 0; i < 3000; ++i, ++said)
            handover.hear(message(1));
    });
    while (said < 1000)
        std::this_thread::yield();
    handover.close();
    bus.join();
    EXPECT_EQ(said, 3000);
    EXPECT_TRUE(handover.take(10).empty());
}

}  // namespace
}  // namespace scipd::daemon
