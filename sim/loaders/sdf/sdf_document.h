// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Prepares an SDF document for libsdformat 12. The library refuses a whole world for an impossible
// inertia, a script without a uri or a version newer than itself. So scipd first takes out what
// does not matter to a scanner, and rewrites what the library cannot read. Any thread; nothing
// shared.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tinyxml2 {
class XMLElement;
}  // namespace tinyxml2

namespace scipd::sim {

/// Replaces "::" in names: one character that looks the same and that nobody uses in a name.
inline constexpr std::string_view stands_for_colons = "\u2237";

/// Takes out what a scanner would see but scipd cannot read. Returns a warning for each, which
/// begins with its place in `file`.
std::vector<std::string> take_unreadable(tinyxml2::XMLElement& root,
                                         const std::filesystem::path& file);

/// Rewrites what libsdformat 12 does not know as elements that it keeps: a <cone> becomes a
/// <scipd:cone>, a <road> becomes a model (sdf_road.h).
void put_in_its_words(tinyxml2::XMLElement& root);

/// Replaces a version that the library does not know by the last one that it knows; the library
/// then skips what newer versions added. Returns a warning if the version is newer than any that
/// scipd knows.
std::vector<std::string> lower_version(tinyxml2::XMLElement& root,
                                       const std::filesystem::path& file);

/// Takes out what does not matter to a scanner: physics, lights, sensors, plugins, colours, and
/// joints that no frame refers to. Returns warnings, as take_unreadable() does.
std::vector<std::string> relieve(tinyxml2::XMLElement& root, const std::filesystem::path& file);

/// Takes out models without links: the library refuses them, and nobody would see them.
void drop_empty_models(tinyxml2::XMLElement& root);

/// A name as its file has it: relieve() replaces "::" in names, since the library uses that itself.
std::string as_in_file(const std::string& name);

}  // namespace scipd::sim
