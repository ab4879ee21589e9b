// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/link/link_model.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using sim::Time;
using testing::ElementsAre;

constexpr sim::ChanceKey chance{.seed = 1, .sensor = 2, .purpose = sim::Purpose::latency_to_client};

struct Arrival {
    Time at;
    std::string bytes;

    bool operator==(const Arrival&) const = default;
};

void PrintTo(const Arrival& arrival, std::ostream* out) {  // NOLINT(readability-identifier-naming)
    *out << arrival.at.count() << " ns: " << arrival.bytes;
}

/// All that comes out, taken at the times at which the model wants to be asked.
std::vector<Arrival> arrivals(LinkModel& link) {
    std::vector<Arrival> all;
    while (const auto at = link.next_at()) {
        while (auto piece = link.take(*at)) {
            EXPECT_GE(*at, piece->at);
            if (!piece->bytes.empty()) all.push_back({piece->at, piece->bytes});
        }
    }
    EXPECT_TRUE(link.empty());
    EXPECT_EQ(link.bytes(), 0U);
    return all;
}

std::string joined(const std::vector<Arrival>& all) {
    std::string bytes;
    for (const Arrival& arrival : all)
        bytes += arrival.bytes;
    return bytes;
}

std::string text(std::size_t size) {
    std::string bytes;
    for (std::size_t i = 0; i < size; ++i)
        bytes += static_cast<char>('0' + i % 64);
    return bytes;
}

TEST(LinkModel, BringsEverythingAtOnceWhereNothingIsBetween) {
    LinkModel link({}, chance);
    EXPECT_EQ(link.next_at(), std::nullopt);
    link.send("first", 1s);
    EXPECT_EQ(link.next_at(), 1s);
    EXPECT_EQ(link.bytes(), 5U);
    EXPECT_EQ(link.take(1s)->bytes, "first");
    link.send(text(100'000), 2s);
    link.send("third", 2s);
    EXPECT_THAT(arrivals(link), ElementsAre(Arrival{2s, text(100'000)}, Arrival{2s, "third"}));
}

TEST(LinkModel, TakesItsTime) {
    LinkModel link({.latency = 30ms}, chance);
    link.send("a", 1s);
    link.send("b", 1s + 10ms);  // while the first is under way
    EXPECT_FALSE(link.take(1s + 29ms));
    EXPECT_EQ(link.take(1s + 30ms)->bytes, "a");
    EXPECT_FALSE(link.take(1s + 30ms));
    EXPECT_THAT(arrivals(link), ElementsAre(Arrival{1s + 40ms, "b"}));
}

TEST(LinkModel, VariesEvenlyToEitherSide) {
    LinkModel link({.latency = 10ms, .jitter = 4ms}, chance);
    constexpr int messages = 10'000;
    std::vector<double> delays_ms;
    for (int i = 0; i < messages; ++i) {
        link.send("x", i * 1s);
        delays_ms.push_back(
            std::chrono::duration<double, std::milli>(*link.next_at() - i * 1s).count());
        ASSERT_EQ(arrivals(link).size(), 1U);
    }
    std::ranges::sort(delays_ms);
    EXPECT_GE(delays_ms.front(), 6.0);
    EXPECT_LE(delays_ms.back(), 14.0);
    // Kolmogorov and Smirnov: a distance of 2.2 / sqrt(n) is exceeded once in 8000 times.
    for (int i = 0; i < messages; ++i) {
        const double share = (delays_ms[static_cast<std::size_t>(i)] - 6.0) / 8.0;
        ASSERT_NEAR(share, (i + 0.5) / messages, 2.2 / std::sqrt(messages));
    }
}

TEST(LinkModel, RepeatsARun) {
    const auto run = [](const sim::ChanceKey& key) {
        LinkModel link({.latency = 10ms, .jitter = 4ms}, key);
        for (int i = 0; i < 20; ++i)
            link.send("x", i * 1s);
        return arrivals(link);
    };
    sim::ChanceKey other_way = chance;
    other_way.purpose = sim::Purpose::latency_to_device;
    EXPECT_EQ(run(chance), run(chance));
    EXPECT_NE(run(chance), run(other_way));
}

TEST(LinkModel, NeverSwapsMessages) {
    LinkModel link({.latency = 10ms, .jitter = 10ms}, chance);
    std::string sent;
    for (int i = 0; i < 1000; ++i) {
        sent += text(static_cast<std::size_t>(i % 50)) + "\n";
        link.send(text(static_cast<std::size_t>(i % 50)) + "\n", i * 100us);
    }
    const auto all = arrivals(link);
    EXPECT_EQ(joined(all), sent);
    EXPECT_TRUE(std::ranges::is_sorted(all, {}, &Arrival::at));
}

TEST(LinkModel, IsNeverTooEarlyForTime) {
    LinkModel link({.latency = 1ms, .jitter = 10ms}, chance);
    for (int i = 0; i < 100; ++i) {
        link.send("x", i * 1s);
        EXPECT_GE(*link.next_at(), i * 1s);
        ASSERT_EQ(arrivals(link).size(), 1U);
    }
}

TEST(LinkModel, CoalescesWhatIsSentWithinItsTime) {
    LinkModel link({.latency = 1ms, .coalesce = 5ms}, chance);
    link.send("a", 100ms);
    link.send("b", 102ms);
    EXPECT_EQ(link.next_at(), 105ms);
    EXPECT_FALSE(link.take(104ms));
    link.send("c", 104ms);
    link.send("d", 105ms);  // the others have left
    EXPECT_EQ(link.bytes(), 4U);
    EXPECT_FALSE(link.take(105ms));
    EXPECT_THAT(arrivals(link), ElementsAre(Arrival{106ms, "abc"}, Arrival{111ms, "d"}));
}

TEST(LinkModel, SplitsIntoPieces) {
    LinkModel link({.latency = 2ms, .split_bytes = 7}, chance);
    link.send(text(20), 1s);
    link.send("short", 1s);
    EXPECT_THAT(arrivals(link),
                ElementsAre(Arrival{1s + 2ms, text(7)}, Arrival{1s + 2ms, text(14).substr(7)},
                            Arrival{1s + 2ms, text(20).substr(14)}, Arrival{1s + 2ms, "short"}));
}

TEST(LinkModel, SplitsWhatItHasCoalesced) {
    LinkModel link({.split_bytes = 4, .coalesce = 5ms}, chance);
    link.send("abc", 0ms);
    link.send("def", 1ms);
    EXPECT_THAT(arrivals(link), ElementsAre(Arrival{5ms, "abcd"}, Arrival{5ms, "ef"}));
}

TEST(LinkModel, SplitsAtPlacesAndPausesBetween) {
    LinkModel link({.latency = 1ms, .split_at = {12, 5, 99}, .split_pause = 3ms}, chance);
    link.send(text(20), 1s);
    link.send("abc", 1s);
    EXPECT_THAT(arrivals(link),
                ElementsAre(Arrival{1s + 1ms, text(5)}, Arrival{1s + 4ms, text(12).substr(5)},
                            Arrival{1s + 7ms, text(20).substr(12)}, Arrival{1s + 7ms, "abc"}));
}

TEST(LinkModel, TakesAnotherConfigForWhatIsSentFromThenOnAndHurriesWhatIsUnderWay) {
    LinkModel link({.latency = 50ms, .coalesce = 10ms}, chance);
    link.send("a", 0ms);
    link.set_config({.split_bytes = 1}, 3ms);
    link.send("bc", 5ms);
    EXPECT_THAT(arrivals(link),
                ElementsAre(Arrival{3ms, "a"}, Arrival{5ms, "b"}, Arrival{5ms, "c"}));
    link.send("de", 100ms);
    EXPECT_THAT(arrivals(link), ElementsAre(Arrival{100ms, "d"}, Arrival{100ms, "e"}));
    link.set_config({.latency = 20ms}, 100ms);
    link.send("fg", 101ms);
    EXPECT_THAT(arrivals(link), ElementsAre(Arrival{121ms, "fg"}));
}

TEST(LinkModel, BringsAByteWhenItsLastBitIsThere) {
    for (const int rate : {19200, 38400, 57600, 115200, 250000, 500000, 750000}) {
        LinkModel link({}, chance);
        link.set_rate(rate);
        link.send(text(500), 1s);
        double bits = 0;
        std::string bytes;
        for (const Arrival& piece : arrivals(link)) {
            // 10 bits each, less than a millisecond's worth in one go or a single one.
            bits += 10.0 * static_cast<double>(piece.bytes.size());
            bytes += piece.bytes;
            EXPECT_NEAR(static_cast<double>((piece.at - 1s).count()), bits / rate * 1e9, 1000.0);
            EXPECT_TRUE(piece.bytes.size() == 1 ||
                        10.0 * static_cast<double>(piece.bytes.size()) / rate <= 0.001);
        }
        EXPECT_EQ(bytes, text(500));
    }
}

TEST(LinkModel, BringsTheFirstByteOfASlowLineByItself) {
    LinkModel link({}, chance);
    link.set_rate(10'000);
    link.send("ab", 1s);
    EXPECT_THAT(arrivals(link), ElementsAre(Arrival{1s + 1ms, "a"}, Arrival{1s + 2ms, "b"}));
}

TEST(LinkModel, KeepsALineBusy) {
    LinkModel link({.latency = 5ms}, chance);
    link.set_rate(10'000);
    link.send("ab", 1s);
    link.send("c", 1s + 1ms);
    link.send("d", 1s + 10ms);  // the line has rested
    EXPECT_THAT(arrivals(link), ElementsAre(Arrival{1s + 6ms, "a"}, Arrival{1s + 7ms, "b"},
                                            Arrival{1s + 8ms, "c"}, Arrival{1s + 16ms, "d"}));
}

TEST(LinkModel, ChangesItsRateAfterWhatWasSentBefore) {
    LinkModel link({.coalesce = 2ms}, chance);
    link.set_rate(10'000);
    link.send("ab", 1s);
    link.set_rate(5'000);
    link.send("c", 1s);
    EXPECT_EQ(link.rate(), 5'000);

    std::vector<int> rates;
    std::vector<Time> times;
    std::string bytes;
    while (const auto at = link.next_at()) {
        while (const auto piece = link.take(*at)) {
            rates.push_back(piece->bits_per_second);
            times.push_back(piece->at);
            bytes += piece->bytes.empty() ? "|" : piece->bytes;
        }
    }
    EXPECT_EQ(bytes, "|ab|c");
    EXPECT_THAT(rates, ElementsAre(10'000, 10'000, 10'000, 5'000, 5'000));
    EXPECT_THAT(std::vector(times.begin() + 1, times.end()),
                ElementsAre(1s + 3ms, 1s + 4ms, 1s + 4ms, 1s + 6ms));
}

TEST(LinkModel, ForgetsWhatIsUnderWay) {
    LinkModel link({.coalesce = 2ms}, chance);
    link.set_rate(10'000);
    link.send(text(100), 1s);
    link.send(text(100), 1s + 3ms);
    link.clear();
    EXPECT_TRUE(link.empty());
    EXPECT_EQ(link.bytes(), 0U);
    EXPECT_EQ(link.next_at(), std::nullopt);
    EXPECT_EQ(link.rate(), 10'000);
    link.send("a", 1s + 4ms);
    EXPECT_THAT(arrivals(link), ElementsAre(Arrival{1s + 7ms, "a"}));
}

}  // namespace
}  // namespace scipd::daemon
