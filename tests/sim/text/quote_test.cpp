// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/text/quote.h"

#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "sim/text/name.h"
#include "tests/support/why_not.h"

namespace scipd::sim {
namespace {

using tests::why_not;

using namespace std::string_literals;

TEST(Shown, KeepsWhatPeopleWrite) {
    for (const std::string text :
         {"", "rescue/front", "a\tb\nc", "Prüfstand", "日本語", "😀", "\xEF\xBF\xBD"})
        EXPECT_EQ(shown(text), text);
}

TEST(Shown, EscapesWhatWouldDoHarm) {
    const std::pair<std::string, std::string> table[] = {
        {"\x1b[31mred", "\\x1b[31mred"},
        {"\0\r\x7f"s, "\\x00\\x0d\\x7f"},
        {"\xc2\x9b"
         "2J",
         "\\xc2\\x9b2J"},  // U+009B, a control of one character
        {"a\xe2\x80\xae"
         "b",
         "a\\xe2\\x80\\xae"
         "b"},                                // U+202E turns what follows
        {"\xe2\x80\xa8", "\\xe2\\x80\\xa8"},  // U+2028 ends a line
        {"\x9b", "\\x9b"},                    // no UTF-8
        {"\xff\xfe", "\\xff\\xfe"},
        {"\xc3", "\\xc3"},  // cut short
        {"\xc3(", "\\xc3("},
        {"\xc0\xaf", "\\xc0\\xaf"},  // longer than it needs to be
        {"\xe0\x80\xaf", "\\xe0\\x80\\xaf"},
        {"\xed\xa0\x80", "\\xed\\xa0\\x80"},           // half of a pair
        {"\xf4\x90\x80\x80", "\\xf4\\x90\\x80\\x80"},  // past the last
    };
    for (const auto& [text, expected] : table)
        EXPECT_EQ(shown(text), expected);
}

TEST(Printable, KeepsWhatPeopleWriteOnOneLine) {
    const std::pair<std::string, std::string> table[] = {
        {"Prüfstand 日本", "Prüfstand 日本"},
        {"ä b/x", "ä b/x"},
        {"a\tb\nc", "a?b?c"},
        {"\x1b[31mred\x7f", "?[31mred?"},
        {"a\xe2\x80\xae"
         "b",
         "a???b"},
        {"\x9b\xc3", "??"},
    };
    for (const auto& [text, expected] : table)
        EXPECT_EQ(printable(text), expected);
    EXPECT_EQ(printable("aöü", 3), "aö...");
    EXPECT_EQ(printable("aöü", 4), "aö...");
    EXPECT_EQ(printable("aöü", 5), "aöü");
    EXPECT_EQ(quote("ä"), "'ä'");
}

TEST(CheckName, BoundsWhatThingsAreCalled) {
    for (const std::string name : {"crate", "model 1", "Kiste ä", "a::b"})
        EXPECT_TRUE(check_name(name));
    EXPECT_TRUE(check_name(std::string(64, 'n')));
    EXPECT_EQ(why_not(check_name(std::string(65, 'n'))), "must be at most 64 bytes long, not 65");
    EXPECT_FALSE(check_name(""));
    for (const std::string name : {"a\nb", "a\tb", "\x1b[2J", "\xff", "\xc2\x85"})
        EXPECT_EQ(why_not(check_name(name)), "must be UTF-8 without control characters");
}

TEST(ShortName, IsShortAndTheNamesOwn) {
    EXPECT_EQ(short_name("crate"), "crate");
    EXPECT_EQ(short_name(std::string(64, 'n')), std::string(64, 'n'));
    const std::string one = short_name(std::string(16'000, 'n') + "1");
    EXPECT_EQ(one.size(), 64U);
    EXPECT_EQ(one.substr(0, 56), std::string(55, 'n') + "~");
    EXPECT_EQ(short_name(std::string(16'000, 'n') + "1"), one);
    EXPECT_NE(short_name(std::string(16'000, 'n') + "2"), one);
    std::string umlauts;
    for (int i = 0; i < 100; ++i)
        umlauts += "ä";
    EXPECT_TRUE(check_name(short_name(umlauts)));
}

}  // namespace
}  // namespace scipd::sim
