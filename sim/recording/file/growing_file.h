// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A file that a recording is written to, piece after piece. Of one owner; any thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string_view>

namespace scipd::sim {

class GrowingFile {
  public:
    /// Replaces an old file. Throws std::runtime_error.
    explicit GrowingFile(const std::filesystem::path& path);

    /// Throws std::runtime_error where the disk is full.
    void write(std::string_view bytes);
    /// What was written so far stays, even if the process is killed. Throws as write().
    void flush();

    /// How much has been written.
    [[nodiscard]] std::uint64_t size() const { return size_; }

  private:
    void check() const;

    std::filesystem::path path_;
    std::ofstream file_;
    std::uint64_t size_ = 0;
};

}  // namespace scipd::sim
