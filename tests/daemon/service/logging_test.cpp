// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The log on a standard error that is a pipe, which is read late or never.
#include "daemon/service/logging.h"

#include <array>
#include <cstddef>
#include <string>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <poll.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

namespace scipd::daemon {
namespace {

using testing::HasSubstr;

/// Standard error for as long as this is there. One thread reads.
class Pipe {
  public:
    Pipe() : before_(dup(STDERR_FILENO)) {
        if (pipe(ends_.data()) != 0) throw std::runtime_error("no pipe");
        fcntl(ends_[1], F_SETPIPE_SZ, 4096);
        dup2(ends_[1], STDERR_FILENO);
        close(ends_[1]);
    }
    ~Pipe() {
        dup2(before_, STDERR_FILENO);
        close(before_);
        close(ends_[0]);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;

    /// All that comes until it ends so, or nothing more comes for long.
    std::string read_until(std::string_view end) {
        std::string text;
        while (!text.ends_with(end)) {
            pollfd waiting{ends_[0], POLLIN, 0};
            if (poll(&waiting, 1, 10'000) != 1) break;
            std::array<char, 4096> bytes;
            const ssize_t size = read(ends_[0], bytes.data(), bytes.size());
            if (size <= 0) break;
            text.append(bytes.data(), static_cast<std::size_t>(size));
        }
        return text;
    }

  private:
    int before_;
    std::array<int, 2> ends_{};
};

std::size_t count(const std::string& text, std::string_view what) {
    std::size_t times = 0;
    for (auto at = text.find(what); at != text.npos; at = text.find(what, at + 1))
        ++times;
    return times;
}

/// May be told in several lines.
std::size_t lost_of(const std::string& text) {
    constexpr std::string_view words = " lines of log were lost\n";
    std::size_t lost = 0;
    for (auto at = text.find(words); at != text.npos; at = text.find(words, at + 1)) {
        const auto number = text.rfind(' ', at - 1);
        lost += std::stoul(text.substr(number, at - number));
    }
    return lost;
}

TEST(Logging, WritesAllThatWasLoggedBeforeItEnds) {
    Pipe pipe;
    start_logging("info");
    spdlog::debug("not this");
    for (int i = 0; i < 50; ++i)  // the pipe holds twice as many
        spdlog::warn("line {}", i);
    EXPECT_TRUE(finish_logging());
    const std::string text = pipe.read_until(" line 49\n");
    EXPECT_EQ(count(text, " warning line "), 50U);
    EXPECT_THAT(text, testing::Not(HasSubstr("not this")));
    EXPECT_THAT(text, testing::Not(HasSubstr("lost")));
}

TEST(Logging, LosesTheOldestLinesOfWhoeverDoesNotReadAndTellsHowMany) {
    Pipe pipe;
    constexpr std::size_t most_waiting = 16;
    constexpr std::size_t lines = 1000;
    start_logging("info", LogFormat::text, most_waiting);
    const std::string filler(1000, '.');  // the pipe holds three
    for (std::size_t i = 0; i < lines; ++i)
        spdlog::warn("line {} {}", i, filler);
    EXPECT_FALSE(finish_logging()) << "nobody reads";
    const std::string text = pipe.read_until("line 999 " + filler + "\n");
    const std::size_t told = count(text, " warning line ");
    ASSERT_GE(told, most_waiting - 1);  // one has made room for the end
    EXPECT_EQ(told + lost_of(text), lines);
    EXPECT_TRUE(finish_logging()) << "somebody has read";
}

TEST(Logging, ShowsWhatOthersWroteAsOneEntryThatDoesNoHarm) {
    Pipe pipe;
    start_logging("info");
    spdlog::warn("no model \"{}\"", "\x1b[2J\n2026-01-01 00:00:00.000 info all is well\xff");
    EXPECT_TRUE(finish_logging());
    EXPECT_THAT(pipe.read_until("\\xff\"\n"),
                testing::EndsWith(" warning no model \"\\x1b[2J\n"
                                  "    2026-01-01 00:00:00.000 info all is well\\xff\"\n"));
}

TEST(Logging, WritesADocumentForEachEntry) {
    Pipe pipe;
    start_logging("info", LogFormat::json);
    tell_log_of({"rescue/front"});
    spdlog::info("rescue/front: backend embree chosen (it is quicker)");
    spdlog::error("rescue/rear: is none of them,\nand {}", "\x1b[2J\xff");
    EXPECT_TRUE(finish_logging());
    const std::string text = pipe.read_until("\\ufffd\"}\n");
    const auto end = text.find('\n');
    const auto about_sensor = nlohmann::json::parse(text.substr(0, end));
    EXPECT_EQ(about_sensor["level"], "info");
    EXPECT_EQ(about_sensor["sensor"], "rescue/front");
    EXPECT_EQ(about_sensor["message"], "backend embree chosen (it is quicker)");
    EXPECT_THAT(text, testing::Not(HasSubstr("\x1b")));
    const auto other = nlohmann::json::parse(text.substr(end));
    EXPECT_EQ(other["level"], "error");
    EXPECT_FALSE(other.contains("sensor"));
    EXPECT_EQ(other["message"], "rescue/rear: is none of them,\nand \x1b[2J\uFFFD");
}

TEST(Logging, TellsTheTimeInUtcAsRfc3339Has) {
    using namespace std::chrono_literals;
    const auto line = [](std::chrono::system_clock::duration since_1970) {
        return json_log_line({std::chrono::system_clock::time_point(since_1970), "info", "x"}, {});
    };
    EXPECT_EQ(line(1'000'000'000s + 7ms),
              R"({"time":"2001-09-09T01:46:40.007Z","level":"info","message":"x"})");
    EXPECT_THAT(line(-1ms), HasSubstr("1969-12-31T23:59:59.999Z"));
}

TEST(Logging, RefusesALevelThatThereIsNot) {
    EXPECT_THROW(start_logging("loud"), std::invalid_argument);
}

}  // namespace
}  // namespace scipd::daemon
