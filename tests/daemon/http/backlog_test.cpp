// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/http/backlog.h"

#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace scipd::daemon {
namespace {

class BacklogTest : public testing::Test {
  protected:
    using Source = std::shared_ptr<Backlog::Source>;

    static Source source(const char* name) {
        return std::make_shared<Backlog::Source>(Backlog::Source{.name = name});
    }

    /// The first letters of all that is there.
    [[nodiscard]] std::string kept() const {
        std::string letters;
        Backlog::Number number = 0;
        for (const auto* message = backlog_.from(number); message != nullptr;
             message = backlog_.from(++number))
            letters += message->text->front();
        return letters;
    }

    std::string lost_;
    Backlog backlog_{[this](Backlog::Number, const Backlog::Message& message) {
        lost_ += message.text->front();
    }};
};

TEST_F(BacklogTest, KeepsMessagesInOrderUntilAllHaveThem) {
    const Source a = source("a");
    const Source b = source("b");
    backlog_.add(a, "1");
    backlog_.add(b, "2");
    backlog_.add(a, "3");
    EXPECT_EQ(kept(), "123");
    backlog_.forget_before(2);
    EXPECT_EQ(kept(), "3");
    EXPECT_EQ(backlog_.bytes(), 1U);
    EXPECT_EQ(backlog_.end(), 3U);
    Backlog::Number number = 0;
    EXPECT_EQ(backlog_.from(number)->source, a);
    EXPECT_EQ(number, 2U);
    backlog_.forget_before(3);
    EXPECT_EQ(backlog_.from(number), nullptr);
    EXPECT_EQ(lost_, "");
}

TEST_F(BacklogTest, KeepsAsManyBytesAsTheLimitAllows) {
    LimitValues values;
    values[Limit::websocket_queue_bytes] = 10;
    const auto limits = std::make_shared<Limits>(values);
    std::string lost;
    Backlog small([&](Backlog::Number, const Backlog::Message& message) { lost += *message.text; },
                  limits);
    const Source a = source("a");
    small.add(a, "12345");
    small.add(a, "67890");
    EXPECT_EQ(lost, "");
    EXPECT_EQ(limits->refused(Limit::websocket_queue_bytes), 0U);
    small.add(a, "x");
    EXPECT_EQ(lost, "12345");
    EXPECT_EQ(limits->refused(Limit::websocket_queue_bytes), 1U);
}

TEST_F(BacklogTest, LosesTheOldestOfASourceOfWhichThereAreMany) {
    const Source fast = source("fast");
    const Source slow = source("slow");
    backlog_.add(slow, "s");
    for (char letter = 'a'; letter < 'a' + 20; ++letter)
        backlog_.add(fast, std::string(1, letter));
    EXPECT_EQ(kept(), "sefghijklmnopqrst");
    EXPECT_EQ(lost_, "abcd");
}

TEST_F(BacklogTest, LosesTheOldestOfAllWhereTheyAreLarge) {
    constexpr std::size_t size = std::size_t{10} << 20U;
    const Source a = source("a");
    const Source b = source("b");
    backlog_.add(b, std::string(size, '0'));
    for (char digit = '1'; digit <= '9'; ++digit)
        backlog_.add(a, std::string(size, digit));
    EXPECT_EQ(kept(), "056789") << "of b there is but one";
    EXPECT_EQ(lost_, "1234");
    EXPECT_EQ(backlog_.bytes(), 6 * size);
}

// However many they are, none is heard at the cost of another.
TEST_F(BacklogTest, KeepsTheNewestOfEachSource) {
    constexpr std::size_t size = std::size_t{10} << 20U;
    std::vector<Source> sources;
    for (int i = 0; i < 9; ++i)
        sources.push_back(source("large"));
    for (const char round : {'x', 'y'}) {
        for (const Source& one : sources)
            backlog_.add(one, std::string(size, round));
    }
    EXPECT_EQ(kept(), "yyyyyyyyy");
    EXPECT_EQ(lost_, "xxxxxxxxx");
}

}  // namespace
}  // namespace scipd::daemon
