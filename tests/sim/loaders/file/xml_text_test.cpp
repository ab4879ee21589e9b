// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/file/xml_text.h"

#include <gtest/gtest.h>

namespace scipd::sim {
namespace {

std::string blanked(std::string text) {
    const std::string before = text;
    const bool any = blank_comments(text);
    EXPECT_EQ(any, text != before);
    EXPECT_EQ(text.size(), before.size());
    return text;
}

TEST(XmlText, commentsBecomeBlanksAndLinesStay) {
    EXPECT_EQ(blanked("<a>1<!-- 2\n<b> -->3</a>"), "<a>1      \n       3</a>");
    EXPECT_EQ(blanked("<a><!----><!-- - -> -->1</a>"), "<a>                    1</a>");
    EXPECT_EQ(blanked("<a x='1'>2 &lt;!-- 3 --></a>"), "<a x='1'>2 &lt;!-- 3 --></a>");
}

TEST(XmlText, onlyADeclarationAtTheStartStays) {
    EXPECT_EQ(blanked("<?xml?><a/>"), "<?xml?><a/>");
    EXPECT_EQ(blanked("\xEF\xBB\xBF\n<?xml?><?b?><a/>"), "\xEF\xBB\xBF\n<?xml?>     <a/>");
    EXPECT_EQ(blanked("<!---->\n<?xml?><a/>"), "       \n       <a/>");
}

TEST(XmlText, whatOnlyLooksLikeACommentStays) {
    EXPECT_EQ(blanked("<a><![CDATA[<!-- 1 -->]]><!-- 2 --></a>"),
              "<a><![CDATA[<!-- 1 -->]]>          </a>");
    EXPECT_EQ(blanked("<a>1<!-- 2</a>"), "<a>1<!-- 2</a>");
    EXPECT_EQ(blanked("1 < 2"), "1 < 2");
    EXPECT_EQ(blanked(""), "");
}

TEST(XmlText, isInUtf8WhateverWasDeclared) {
    const std::string latin = "<?xml version='1.0' encoding=\"iso-8859-1\"?><a>\xE9\xFF</a>";
    EXPECT_EQ(in_utf8(latin),
              "<?xml version='1.0' encoding=\"iso-8859-1\"?><a>\xC3\xA9\xC3\xBF</a>");
    for (const std::string text : {"<?xml encoding='UTF-8'?><a>\xC3\xA9</a>", "<a>\xE9</a>",
                                   "<?xml version='1.0'?><a encoding='ISO-8859-1'>\xE9</a>"}) {
        EXPECT_EQ(in_utf8(text), text);
    }
}

}  // namespace
}  // namespace scipd::sim
