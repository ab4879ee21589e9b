// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Limits what Assimp may open while it reads a mesh: the mesh, and plain files in its folder and in
// the folders below. A mesh can name anything, such as a device, a FIFO that nobody writes to or
// the files of another user, and the library would open it. One thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <assimp/DefaultIOSystem.h>

#include "sim/expected.h"

namespace scipd::sim {

class MeshFolder final : public Assimp::DefaultIOSystem {
  public:
    explicit MeshFolder(const std::filesystem::path& mesh);

    /// Gives Assimp these contents in place of the mesh's own, and lets it open no file that only
    /// tells how the mesh looks (.mtl).
    void relieve(std::string contents) { relieved_ = std::move(contents); }

    bool Exists(const char* file) const override;
    /// Null if the file may not be opened. Nothing may be opened for writing.
    Assimp::IOStream* Open(const char* file, const char* mode) override;

    /// Why Assimp was refused the first file that it did not get; empty if it got all.
    [[nodiscard]] const std::string& refusal() const { return refusal_; }

  private:
    /// Whether the file may be opened.
    [[nodiscard]] Expected<> check(const std::filesystem::path& file) const;

    std::filesystem::path mesh_;
    std::optional<std::string> relieved_;
    /// The folder of the mesh as it is named, and that of the file to which its name links: some
    /// installations link file by file.
    std::vector<std::filesystem::path> folders_;
    std::string refusal_;
};

}  // namespace scipd::sim
