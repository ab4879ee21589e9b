// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A folder for what a program writes that we start: from now until this goes. One thread.
#pragma once

#include <filesystem>
#include <string>

namespace scipd::tools {

class TemporaryFolder {
  public:
    /// Its name begins like this. Throws std::system_error.
    explicit TemporaryFolder(const std::string& beginning);
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder();

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace scipd::tools
