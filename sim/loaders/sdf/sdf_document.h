// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// An SDF document on its way to libsdformat 12, which refuses a whole world for an inertia that no
// mass can have, a script without a uri or a version newer than itself. What is nothing to a
// scanner is taken out before the library sees it, and what it cannot read is put in its words. Any
// thread; nothing shared.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tinyxml2 {
class XMLElement;
}  // namespace tinyxml2

namespace scipd::sim {

/// In place of "::" in names: one character that nobody has in a name, and that says the same.
inline constexpr std::string_view stands_for_colons = "\u2237";

/// Takes out what a scanner would see and we cannot read. Answers with a warning for each, which
/// begins with its place in `file`.
std::vector<std::string> take_unreadable(tinyxml2::XMLElement& root,
                                         const std::filesystem::path& file);

/// Puts what libsdformat 12 does not know in words that it carries along: a <cone> becomes a
/// <scipd:cone>, a <road> a model (sdf_road.h).
void put_in_its_words(tinyxml2::XMLElement& root);

/// A version that the library does not know becomes the last that it knows; it skips what is new
/// since then. Answers with a warning where the version is newer than any known here.
std::vector<std::string> lower_version(tinyxml2::XMLElement& root,
                                       const std::filesystem::path& file);

/// Takes out what is nothing to a scanner: physics, lights, sensors, plugins, colours, and joints
/// that no frame refers to. Answers with warnings, as take_unreadable().
std::vector<std::string> relieve(tinyxml2::XMLElement& root, const std::filesystem::path& file);

/// The library wants a link in each; a model of none is one that nobody sees.
void drop_empty_models(tinyxml2::XMLElement& root);

/// A name as its file has it: a document that went through relieve() has no "::" in names, which
/// the library takes for its own.
std::string as_in_file(const std::string& name);

}  // namespace scipd::sim
