// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A look at an SDF or URDF file and all that it includes before libsdformat sees them: the library
// follows includes without end, stops at the first that it cannot find, and takes much more memory
// than the file has bytes. Any thread.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim/loaders/resources.h"

namespace scipd::sim {

/// A file, or a text that messages call by the name `file`.
struct SdfSource {
    std::filesystem::path file;
    std::optional<std::string> text = std::nullopt;
};

struct SdfSurvey {
    /// What every include names, by its URI: a file, or the folder of a model.
    std::map<std::string, std::filesystem::path> includes;
    std::vector<std::string> faults;
};

/// Broken XML is not its business: the library tells of it.
SdfSurvey survey_sdf(const SdfSource& source, const Resources& resources,
                     std::size_t most_memory_bytes);

}  // namespace scipd::sim
