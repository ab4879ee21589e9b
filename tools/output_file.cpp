// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/output_file.h"

#include <filesystem>
#include <system_error>

namespace scipd::tools {

std::string can_be_written(const std::string& file) {
    const std::filesystem::path path(file);
    const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
    std::error_code error;
    if (!std::filesystem::is_directory(folder, error))
        return "there is no directory " + folder.string();
    if (std::filesystem::is_directory(path, error)) return file + " is a directory; name a file";
    return "";
}

std::string is_picture(const std::string& file) {
    const auto ending = std::filesystem::path(file).extension();
    return ending == ".png" || ending == ".svg" ? "" : "must end with .png or .svg";
}

}  // namespace scipd::tools
