// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// An SDF or URDF file and all that it includes, made ready for libsdformat: the library follows
// includes without end, stops at the first that it cannot find, takes much more memory than the
// file has bytes and refuses what is nothing to a scanner (sdf_document.h). Any thread.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/loaders/sdf/resources.h"
#include "sim/loaders/sdf/sdf_sensors.h"

namespace scipd::sim {

/// A file, or a text that messages call by the name `file`.
struct SdfSource {
    std::filesystem::path file;
    std::optional<std::string> text = std::nullopt;
};

/// As the library is to read it: an include names the document that it means by uri_of().
struct SdfDocument {
    std::filesystem::path file;
    std::string text;
    bool is_relieved_of_all = false;  ///< there was something in it, but nothing to a scanner
};

struct SdfSurvey {
    std::vector<SdfDocument> documents;  ///< the source first, then each include once
    std::vector<std::string> faults;
    std::vector<std::string> warnings;
    std::vector<FoundSensor> sensors;  ///< of all documents but robots
};

/// Of a document by its place among them, by which the library asks for it.
std::string uri_of(std::size_t document);

/// What cannot be included is left out with a warning; `strict` makes that a fault, and leaves the
/// documents as they are.
SdfSurvey survey_sdf(const SdfSource& source, const Resources& resources,
                     std::size_t most_memory_bytes, bool strict);

}  // namespace scipd::sim
