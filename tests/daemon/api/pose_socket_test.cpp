// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The WebSocket /poses: how much of a message is taken at a time, and what is answered.
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "daemon/api/pose_routes.h"
#include "daemon/limits/rate.h"
#include "tests/support/empty_api.h"

namespace scipd::daemon {
namespace {

using nlohmann::json;

/// Refuses what is rubbish.
class PosedApi : public tests::EmptyApi {
  public:
    sim::Expected<> admit_pose(Rate& sender) override {
        if (sender.admit(most_, Rate::Time{})) return {};
        return sim::refuse("too many");
    }
    sim::Expected<> take_pose_line(std::string_view line, SenderClock&) override {
        ++lines_;
        if (line.starts_with("rubbish"))
            return sim::refuse("xyz", "xyz: " + std::string(line.substr(0, 9)));
        return {};
    }

    std::size_t lines_ = 0;
    std::size_t most_ = 1'000'000;
};

class PoseClient : public WebSocket {
  public:
    void send(std::shared_ptr<const std::string> message) override {
        told_.push_back(json::parse(*message));
    }

    void send_bytes(std::shared_ptr<const std::string>) override {}
    void cut() override {}

    std::vector<json> told_;
};

class PoseSocketTest : public testing::Test {
  protected:
    /// Answers with the most lines that were taken at once.
    std::size_t send(std::string_view message) {
        std::size_t most = 0;
        do {
            const std::size_t before = api_.lines_;
            message.remove_prefix(talk_->take(message));
            most = std::max(most, api_.lines_ - before);
        } while (!message.empty());
        return most;
    }

    PosedApi api_;
    PoseClient client_;
    std::unique_ptr<Conversation> talk_ = take_poses(api_, client_);
};

std::string repeated(const std::string& text, std::size_t times) {
    std::string all;
    for (std::size_t i = 0; i < times; ++i)
        all += text;
    return all;
}

TEST_F(PoseSocketTest, AnswersAMessageOnceHoweverMuchOfItIsRefused) {
    constexpr std::size_t lines = 100'000;
    send("good\n");
    EXPECT_LE(send(repeated("rubbish\n", lines)), 100U);
    EXPECT_EQ(api_.lines_, 1 + lines);
    ASSERT_EQ(client_.told_.size(), 1U);
    EXPECT_EQ(client_.told_[0], json({{"type", "about:blank"},
                                      {"title", "Bad Request"},
                                      {"status", 400},
                                      {"detail", "xyz: rubbish"},
                                      {"field", "xyz"},
                                      {"line", 2},
                                      {"refused", lines}}));
}

TEST_F(PoseSocketTest, TakesALongMessageOfGoodLinesInParts) {
    constexpr std::size_t lines = 10'000;
    EXPECT_LE(send(repeated("good\n", lines)), 100U);
    EXPECT_EQ(api_.lines_, lines);
    // Long lines take longer.
    EXPECT_LE(send(repeated(std::string(4000, ' ') + "good\n", 100)), 2U);
    EXPECT_EQ(api_.lines_, lines + 100);
    EXPECT_TRUE(client_.told_.empty());
}

TEST_F(PoseSocketTest, SaysWhenAPoseIsOneTooMany) {
    api_.most_ = 3;
    send("good\ngood\ngood");
    EXPECT_TRUE(client_.told_.empty());
    send("good\ngood");
    EXPECT_EQ(api_.lines_, 3U);
    ASSERT_EQ(client_.told_.size(), 1U);
    EXPECT_EQ(client_.told_[0]["status"], 429);
    EXPECT_EQ(client_.told_[0]["title"], "Too Many Requests");
    EXPECT_EQ(client_.told_[0]["detail"], "too many");
    EXPECT_EQ(client_.told_[0]["refused"], 2);
    const auto other = take_poses(api_, client_);
    other->take("good");
    EXPECT_EQ(api_.lines_, 4U) << "another WebSocket is another sender";
}

TEST_F(PoseSocketTest, TellsOfEachMessageItsFirstRefusal) {
    send("good\n\nrubbish 1\n# nothing\nrubbish 2");
    send("");
    send("rubbish 3\ngood");
    send("good");
    ASSERT_EQ(client_.told_.size(), 2U);
    EXPECT_EQ(client_.told_[0]["detail"], "xyz: rubbish 1");
    EXPECT_EQ(client_.told_[0]["line"], 3);
    EXPECT_EQ(client_.told_[0]["refused"], 2);
    EXPECT_EQ(client_.told_[1]["line"], 6);
    EXPECT_EQ(client_.told_[1]["refused"], 1);
}

}  // namespace
}  // namespace scipd::daemon
