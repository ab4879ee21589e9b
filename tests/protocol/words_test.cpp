// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What is said of requests and statuses: all of the command table, and all of the tables in
// docs/protocol.md.
#include "protocol/words.h"

#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "protocol/command_table.h"

namespace scipd::protocol {
namespace {

using testing::HasSubstr;
using testing::Not;

Request request_of(const Command& command, const std::string& digits) {
    return {.echo = std::string(command.code) + digits,
            .command = &command,
            .parameters_length = digits.size()};
}

const Command& command_of(std::string_view code) {
    for (const Command& command : command_table()) {
        if (command.code == code) return command;
    }
    ADD_FAILURE() << code;
    return command_table().front();
}

std::string words_of(std::string_view code, const std::string& digits = {}) {
    return request_words(request_of(command_of(code), digits));
}

/// The first cells of the table in docs/protocol.md that has this head, taken apart at commas.
std::vector<std::string> documented(const std::string& head) {
    std::ifstream page(SCIPD_SOURCES "/docs/protocol.md");
    std::string line;
    while (std::getline(page, line) && !line.starts_with("| " + head))
        ;
    std::getline(page, line);
    std::vector<std::string> found;
    while (std::getline(page, line) && line.starts_with("| ")) {
        std::string cell = line.substr(2, line.find(" |", 2) - 2) + ",";
        for (std::size_t end = 0; (end = cell.find(',')) != std::string::npos;) {
            found.push_back(cell.substr(0, end));
            cell.erase(0, end + 1);
            if (cell.starts_with(' ')) cell.erase(0, 1);
        }
    }
    return found;
}

TEST(Words, AreThereForEveryCommand) {
    std::set<std::string> told;
    for (const Command& command : command_table()) {
        const auto request = request_of(command, std::string(width(command.parameters), '1'));
        const std::string words = request_words(request);
        EXPECT_THAT(words, Not(HasSubstr("no command"))) << command.code;
        EXPECT_THAT(words, Not(testing::IsEmpty())) << command.code;
        if (command.code != "TM" && command.code != "%TM") {
            EXPECT_TRUE(told.insert(words).second) << command.code << " is told like another one";
            EXPECT_THAT(reply_words(request, status::ok), Not(testing::IsEmpty())) << command.code;
        }
        EXPECT_NO_FATAL_FAILURE((void)request_words(request_of(command, "1")));
        EXPECT_NO_FATAL_FAILURE((void)reply_words(request_of(command, ""), status::scan_follows));
    }
}

TEST(Words, AreThereForEveryDocumentedCommand) {
    const auto codes = documented("command ");
    EXPECT_GT(codes.size(), 30U);
    for (const std::string& code : codes)
        EXPECT_THAT(words_of(code), Not(testing::IsEmpty())) << code;
}

TEST(Words, AreThereForEveryDocumentedStatus) {
    auto codes = documented("status ");
    EXPECT_GT(codes.size(), 10U);
    for (const std::string never_sent : {"0A", "0B", "0I"})
        codes.push_back(never_sent);
    for (const std::string& code : codes) {
        if (code == "01 to 07") continue;
        const auto status = Status::parse(code);
        ASSERT_TRUE(status) << code;
        EXPECT_THAT(std::string(status_words(nullptr, *status)), Not(testing::IsEmpty())) << code;
    }
}

TEST(Words, AreThereForEveryStatusOfTheCommandTable) {
    for (const Command& command : command_table()) {
        for (const Gate& gate : command.gates) {
            for (std::size_t state = 0; state < state_count; ++state) {
                const auto status = gate.refusal(static_cast<State>(state));
                if (!status) continue;
                EXPECT_THAT(std::string(status_words(&command, *status)), Not(testing::IsEmpty()))
                    << command.code << ' ' << status->text();
            }
        }
    }
}

TEST(Words, TellWhatANumberMeansToTheCommand) {
    EXPECT_EQ(status_words(&command_of("MD"), status::scan::end_before_start),
              "the last step lies before the first");
    EXPECT_EQ(status_words(&command_of("BM"), status::already_on), "the laser is on already");
    EXPECT_EQ(status_words(&command_of("TM2"), status::not_in),
              "the scanner is not in time-adjust mode");
    EXPECT_EQ(status_words(&command_of("SS"), status::setting::unchanged),
              "this is the present value");
    EXPECT_THAT(std::string(status_words(&command_of("GD"), status::denied)), HasSubstr("BM"));
    EXPECT_EQ(status_words(&command_of("VV"), status::scan::no_such_step), "");
}

TEST(Words, TellWhatIsAskedFor) {
    EXPECT_EQ(words_of("MD", "0000108001000"),
              "requests an endless stream of distances, steps 0 to 1080");
    EXPECT_EQ(words_of("ME", "0044072503210"),
              "requests 10 scans of distances and intensities, steps 44 to 725, one value for 3 "
              "steps, passing over 2 turns each time");
    EXPECT_EQ(words_of("GS", "0000076800"),
              "requests one scan of distances of two characters, steps 0 to 768");
    EXPECT_EQ(words_of("MD", "x"), "requests distances") << "too short";
    EXPECT_EQ(words_of("MD", "xxxxxxxxxxxxx"), "requests an endless stream of distances");
    EXPECT_EQ(request_words({.echo = "XX"}), "no command that this scanner knows");
}

TEST(Words, TellWhatTheReplyIs) {
    const auto reply = [](std::string_view code, const std::string& digits, Status status) {
        return reply_words(request_of(command_of(code), digits), status);
    };
    EXPECT_EQ(reply("VV", "", status::ok), "returns the version");
    EXPECT_EQ(reply("MD", "0000108001000", status::ok), "the stream begins");
    EXPECT_EQ(reply("MD", "0000108001009", status::scan_follows),
              "a scan of the stream; echoed scan count: 09");
    EXPECT_EQ(reply("MD", "0000108001000", status::scan_follows),
              "a scan of the stream; echoed scan count: 00 (endless, or the last one)");
    EXPECT_EQ(reply("GD", "0000108001", status::ok), "the requested scan");
    EXPECT_EQ(reply("GD", "0000108001", status::denied), "not carried out");
}

}  // namespace
}  // namespace scipd::protocol
