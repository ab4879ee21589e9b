// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The law of a folder, which stands in the first lines of its README.md:
//
//   - May include: `sim/time.h`, `sim/world/`, `glm/`.
//   - `confined.cpp` alone may also include `poll.h`, `sys/`: child processes live behind it.
//   - Never reaches: `protocol/`.
//
// Its own files and the standard library are free to every folder. A name that ends in `/` stands
// for all below it, one that ends in `/*` for the files of that folder alone. A value.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace scipd::testing {

using Names = std::vector<std::string>;

/// What some files of a folder may include that the others may not.
struct Exemption {
    Names files;
    Names may_include;
};

struct FolderLaw {
    Names may_include;
    std::vector<Exemption> exemptions;
    Names never_reaches;  ///< not even by way of other headers
};

/// Every name between backticks counts. Nothing where the text does not say what may be included.
std::optional<FolderLaw> law_in(std::string_view readme);

/// Whether one of the names stands for this file.
bool is_among(std::string_view file, const Names& names);

/// Where a folder or its law lets a file of it include this.
bool may_include(const FolderLaw& law, std::string_view file, std::string_view included);

/// With the slash; empty where there is none.
std::string_view folder_of(std::string_view file);

}  // namespace scipd::testing
