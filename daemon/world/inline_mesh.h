// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A mesh that came as bytes, as a file for as long as it is read: nothing else lies in its folder,
// so that it can name nothing else. Any thread.
#pragma once

#include <filesystem>
#include <string>

namespace scipd::daemon {

class InlineMesh {
  public:
    /// `data` is base64; `format` is how the file's name shall end. Throws LoadError.
    InlineMesh(const std::string& data, const std::string& format);
    InlineMesh(const InlineMesh&) = delete;
    InlineMesh& operator=(const InlineMesh&) = delete;
    ~InlineMesh();

    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
    [[nodiscard]] const std::filesystem::path& file() const { return file_; }

  private:
    std::filesystem::path folder_;
    std::filesystem::path file_;
};

}  // namespace scipd::daemon
