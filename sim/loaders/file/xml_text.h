// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Prepares the text of an XML file for readers that do not take comments everywhere, nor any other
// encoding than UTF-8. Any thread; nothing shared.
#pragma once

#include <string>

namespace scipd::sim {

/// Puts blanks in place of comments and of instructions to programs (<?...?>), but for a
/// declaration that the text begins with; lines keep their numbers. tinyxml2 refuses a comment in
/// front of the declaration, Assimp refuses one between some elements, and both end a text where a
/// comment begins. True if there was anything to blank out.
bool blank_comments(std::string& text);

/// The text in UTF-8, if its declaration says that it is in ISO-8859-1; any other as it is, since
/// tinyxml2 takes all for UTF-8.
std::string in_utf8(const std::string& text);

}  // namespace scipd::sim
