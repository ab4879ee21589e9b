// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The sources as text, and what is wrong with their dependencies. The laws come from the READMEs of
// the folders (folder_law.h). One thread.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace scipd::testing {

/// Sources and READMEs, by their path from the root.
using SourceTree = std::map<std::string, std::string, std::less<>>;

/// The sources of all five folders.
SourceTree tree_at(const std::filesystem::path& root);

// Each returns one sentence for every fault. The sentence begins with the file or folder at fault.

/// Folders without a law, and laws that name what does not exist.
std::vector<std::string> faults_of_laws(const SourceTree& tree);

/// Includes that a law does not allow, or that no law may allow.
std::vector<std::string> faults_of_includes(const SourceTree& tree);

/// Files that reach, through other headers, what the law of their folder rules out.
std::vector<std::string> faults_of_reach(const SourceTree& tree);

/// Files with too many lines.
std::vector<std::string> faults_of_length(const SourceTree& tree);

/// Headers that have the name of another one, anywhere in the five folders, and what lies right in
/// daemon/ but belongs into a folder of it.
std::vector<std::string> faults_of_names(const SourceTree& tree);

/// "A <-> B" for two units (a header with its source), or two folders, that include each other.
std::vector<std::string> pairs_in(const SourceTree& tree);

}  // namespace scipd::testing
