// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The files of the page as the build has taken them in. Constant; any thread.
#pragma once

#include <span>
#include <string_view>

namespace scipd::daemon {

struct PageFile {
    std::string_view name;  ///< "index.html"
    std::string_view hash;  ///< hexadecimal digits of the content
    std::string_view content;
};

/// None in a build without the page.
std::span<const PageFile> page_files();

}  // namespace scipd::daemon
