// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The rules of a folder (its law), which stand in the first lines of its README.md:
//
//   - May include: `sim/time.h`, `sim/world/`, `glm/`.
//   - `confined.cpp` alone may also include `poll.h`, `sys/`: child processes live behind it.
//   - Never reaches: `protocol/`.
//
// Every folder may include its own files and the standard library. A name that ends in `/` stands
// for everything below it. A name that ends in `/*` stands for the files of that folder alone. A
// value.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace scipd::testing {

using Names = std::vector<std::string>;

/// What some files of a folder may include but others may not.
struct Exemption {
    Names files;
    Names may_include;
};

struct FolderLaw {
    Names may_include;
    std::vector<Exemption> exemptions;
    Names never_reaches;  ///< not even through other headers
};

/// Reads every name between backticks. Nothing if the text does not say what may be included.
std::optional<FolderLaw> law_in(std::string_view readme);

/// Whether one of the names stands for this file.
bool is_among(std::string_view file, const Names& names);

/// Whether the law lets this file of the folder include that one.
bool may_include(const FolderLaw& law, std::string_view file, std::string_view included);

/// The folder with its slash; empty if there is none.
std::string_view folder_of(std::string_view file);

}  // namespace scipd::testing
