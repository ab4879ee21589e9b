// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/stage/stage_tokens.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/loaders/file/load_error.h"

namespace scipd::sim {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Kind = StageToken::Kind;

std::optional<StageText> nothing_else(const std::string&, const std::filesystem::path&) {
    return std::nullopt;
}

TEST(StageTokens, AreWordsNumbersTextsAndBrackets) {
    const auto tokens = stage_tokens({"a.world",
                                      "wall ( # a remark\n point[0] [-1.5e-3 .5]\n"
                                      "name \"a (b) # c\" )"},
                                     nothing_else);
    std::string shown;
    for (const StageToken& token : tokens.all)
        shown += std::to_string(static_cast<int>(token.kind)) + token.text + ' ';
    EXPECT_EQ(shown, "0wall 3( 0point[0] 5[ 1-1.5e-3 1.5 6] 0name 2a (b) # c 4) ");
    EXPECT_EQ(tokens.place_of(tokens.all[0]), "a.world:1");
    EXPECT_EQ(tokens.place_of(tokens.all[2]), "a.world:2");
    EXPECT_EQ(tokens.place_of(tokens.all.back()), "a.world:3");
}

TEST(StageTokens, HaveThoseOfAnIncludedFileInItsPlace) {
    const auto find = [](const std::string& name, const std::filesystem::path& by) {
        EXPECT_EQ(by, "a.world");
        return name == "b.inc" ? std::optional(StageText{"b.inc", "\n two"}) : std::nullopt;
    };
    const auto tokens =
        stage_tokens({"a.world", "one include \"b.inc\" three\ninclude \"c.inc\" four"}, find);
    std::vector<std::string> places;
    for (const StageToken& token : tokens.all)
        places.push_back(token.text + ' ' + tokens.place_of(token));
    EXPECT_THAT(places,
                ElementsAre("one a.world:1", "two b.inc:2", "three a.world:1", "four a.world:2"));
    EXPECT_THAT(tokens.warnings, ElementsAre(HasSubstr("a.world:2: there is no")));
}

TEST(StageTokens, AreRefusedWithFileAndLine) {
    const auto faults = [](const std::string& text, const FindInclude& find) {
        try {
            stage_tokens({"a.world", text}, find);
        } catch (const LoadError& error) {
            return error.faults();
        }
        return std::vector<std::string>{};
    };
    EXPECT_THAT(faults("\n{", nothing_else), ElementsAre(HasSubstr("a.world:2: ")));
    EXPECT_THAT(faults("\"no end\n\"", nothing_else),
                ElementsAre(HasSubstr("a.world:1: a text has no closing quote")));
    EXPECT_THAT(faults("include b", nothing_else), ElementsAre(HasSubstr("include wants")));
    const auto itself = [](const std::string&, const std::filesystem::path&) {
        return std::optional(StageText{"a.world", "include \"a.world\""});
    };
    EXPECT_THAT(faults("include \"a.world\"", itself),
                ElementsAre(HasSubstr("do they go in circles?")));
}

}  // namespace
}  // namespace scipd::sim
