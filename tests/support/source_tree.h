// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The sources as text, and what is wrong with how they lean on each other. Knows the laws from the
// READMEs of their folders (folder_law.h). One thread.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace scipd::testing {

/// By path from the root: sources and READMEs.
using SourceTree = std::map<std::string, std::string, std::less<>>;

/// The sources of all four folders.
SourceTree tree_at(const std::filesystem::path& root);

// Each answers with one sentence for every fault, which begins with the file or folder at fault.

/// Folders without a law, and laws that speak of what is not there.
std::vector<std::string> faults_of_laws(const SourceTree& tree);

/// Includes that a law does not allow, or that no law may allow.
std::vector<std::string> faults_of_includes(const SourceTree& tree);

/// What a file reaches by way of other headers although the law of its folder rules it out.
std::vector<std::string> faults_of_reach(const SourceTree& tree);

/// Files past their budget of lines.
std::vector<std::string> faults_of_length(const SourceTree& tree);

/// "A <-> B" of two units (a header with its source), or two folders, that include each other.
std::vector<std::string> pairs_in(const SourceTree& tree);

}  // namespace scipd::testing
