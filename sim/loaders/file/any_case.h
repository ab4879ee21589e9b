// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Finds files whose names differ from the requested name only in upper and lower case. Worlds that
// were made on a file system that ignores case often name files so. Nothing is found that this
// process must not read: nobody learns what lies there. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace scipd::sim {

/// Turns A to Z into a to z; all other bytes stay.
std::string lower(std::string_view text);

/// The path of the file or folder with exactly this name in `folder`; empty if there is none.
std::filesystem::path exactly(const std::filesystem::path& folder,
                              const std::filesystem::path& name);

/// As exactly(), but a part of the name that does not exist as written may differ in case.
std::filesystem::path in_any_case(const std::filesystem::path& folder,
                                  const std::filesystem::path& name);

/// Returns `file` if it exists, or if no name like it exists. Otherwise returns the path whose name
/// differs only in case, and adds a warning.
std::filesystem::path as_it_is_called(const std::filesystem::path& file,
                                      std::vector<std::string>& warnings);

/// Whether `found` ends in `name` in another case, and not as written.
bool differs_in_case(const std::filesystem::path& found, const std::filesystem::path& name);

}  // namespace scipd::sim
