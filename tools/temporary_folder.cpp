// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/temporary_folder.h"

#include <cerrno>
#include <cstdlib>
#include <system_error>

namespace scipd::tools {

TemporaryFolder::TemporaryFolder(const std::string& beginning) {
    std::string pattern = std::filesystem::temp_directory_path() / (beginning + "-XXXXXX");
    if (::mkdtemp(pattern.data()) == nullptr)
        throw std::system_error(errno, std::generic_category(), pattern);
    path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

}  // namespace scipd::tools
