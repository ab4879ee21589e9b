// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reading one file through libsdformat, and every word that the library has to say about it. Any
// thread: the library speaks through a console that the whole process shares, so readers wait for
// each other.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <sdf/Root.hh>

namespace scipd::sim {

struct SdfFile {
    sdf::Root root;  ///< complete where there are no faults
    std::vector<std::string> faults;
    std::vector<std::string> warnings;
};

/// Wants an absolute path.
SdfFile read_sdf_file(const std::filesystem::path& file);

/// FILE:LINE of an element, as far as the library knows; `file` where it does not.
std::string place_of(const sdf::ElementPtr& element, const std::filesystem::path& file);

/// Where the file lies that `uri` names in a file in `folder`: relative, absolute, file:// and, as
/// far as it can be told from where the file lies, model:// and package://. Empty where there is
/// none.
std::filesystem::path find_resource(const std::string& uri, const std::filesystem::path& folder);

}  // namespace scipd::sim
