// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Files whose names differ from what is asked for in capitals only: a world made where that makes
// no difference names them as it likes. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace scipd::sim {

/// A to Z as a to z.
std::string lower(std::string_view text);

/// What there is of this name in a folder; empty where there is nothing.
std::filesystem::path exactly(const std::filesystem::path& folder,
                              const std::filesystem::path& name);

/// The same, each part of the name in any case where it is not there as it stands.
std::filesystem::path in_any_case(const std::filesystem::path& folder,
                                  const std::filesystem::path& name);

/// The file itself where it is there, or where there is nothing like it; else the one that is
/// called so in another case, with a warning.
std::filesystem::path as_it_is_called(const std::filesystem::path& file,
                                      std::vector<std::string>& warnings);

/// Whether `found` ends in `name` but for the case.
bool differs_in_case(const std::filesystem::path& found, const std::filesystem::path& name);

}  // namespace scipd::sim
