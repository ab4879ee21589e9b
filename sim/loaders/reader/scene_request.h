// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What scipd asks of scipd-read: a world or a model, and within which bounds. A value.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>

#include <sys/types.h>

#include "sim/loaders/file/allowed_folder.h"
#include "sim/loaders/file/new_model.h"
#include "sim/loaders/map/map_options.h"
#include "sim/loaders/sdf/sdf_options.h"

namespace scipd::sim {

struct SceneRequest {
    using World = std::filesystem::path;

    std::variant<World, NewModel> wanted;
    SdfOptions sdf;
    MapOptions map;
    std::size_t most_overlap;
    std::optional<Folders> folders;  ///< as in LoadLimits
    std::size_t memory_bytes;
    std::chrono::seconds processor_time;
    pid_t asked_by;  ///< scipd-read ends with this process

    /// How messages call what is wanted.
    [[nodiscard]] std::string name() const;
    /// The file to begin with; empty if the request itself has the text.
    [[nodiscard]] std::filesystem::path file() const;
    /// Whether the program xacro is to read that file.
    [[nodiscard]] bool runs_xacro() const;
};

void put_request(const SceneRequest& request, std::FILE* out);
/// Throws std::runtime_error where the bytes are no request of this version of scipd.
SceneRequest take_request(std::FILE* in);

}  // namespace scipd::sim
