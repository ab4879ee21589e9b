// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A folder for the files of one test, gone with it.
#pragma once

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include <stdlib.h>

#include "sim/loaders/load_error.h"

namespace scipd::sim {

class TempFolder {
  public:
    TempFolder() {
        std::string pattern = std::filesystem::temp_directory_path() / "scipd-test-XXXXXX";
        if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
        path_ = pattern;
    }
    ~TempFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;

    /// Writes a file, and the folders above it.
    std::filesystem::path write(const std::string& name, std::string_view text) const {
        const auto file = path_ / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream{file, std::ios::binary} << text;
        return file;
    }

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

/// The faults of a call that must throw a LoadError, each without the folder's path wherever it
/// stands.
template <typename Call>
std::vector<std::string> faults_of(const Call& call, const TempFolder& folder) {
    std::vector<std::string> faults;
    try {
        call();
    } catch (const LoadError& error) {
        faults = error.faults();
    }
    const auto prefix = folder.path().string() + '/';
    for (auto& fault : faults) {
        for (auto at = fault.find(prefix); at != fault.npos; at = fault.find(prefix)) {
            fault.erase(at, prefix.size());
        }
    }
    return faults;
}

}  // namespace scipd::sim
