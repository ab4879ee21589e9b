// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What Assimp may open while it reads a mesh: the mesh, and the files beside it and in the folders
// below that, where these are plain files. A mesh can name anything, a device, a FIFO that nobody
// writes to or somebody else's files, and the library would open it. One thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <assimp/DefaultIOSystem.h>

namespace scipd::sim {

class MeshFolder final : public Assimp::DefaultIOSystem {
  public:
    explicit MeshFolder(const std::filesystem::path& mesh);

    /// The mesh holds this; nothing beside it that only says how it looks may be opened.
    void relieve(std::string contents) { relieved_ = std::move(contents); }

    bool Exists(const char* file) const override;
    /// Null where it may not be opened; nothing is ever written.
    Assimp::IOStream* Open(const char* file, const char* mode) override;

    /// Why the first file beside the mesh that was asked for could not be had; empty where all
    /// could.
    [[nodiscard]] const std::string& refusal() const { return refusal_; }

  private:
    /// Empty where it may be opened.
    [[nodiscard]] std::string why_not(const std::filesystem::path& file) const;

    std::filesystem::path mesh_;
    std::optional<std::string> relieved_;
    /// Of the mesh as it is named, and of what that leads to: installations link file by file.
    std::vector<std::filesystem::path> folders_;
    std::string refusal_;
};

}  // namespace scipd::sim
