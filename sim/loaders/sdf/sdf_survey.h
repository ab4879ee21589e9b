// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Prepares an SDF or URDF file and everything that it includes for libsdformat. Alone, the library
// follows includes without end, stops at the first one that it cannot find, takes far more memory
// than the file has bytes, and refuses faults that do not matter to a scanner (sdf_document.h). Any
// thread.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/loaders/mesh/mesh_shelf.h"
#include "sim/loaders/sdf/resources.h"
#include "sim/loaders/sdf/sdf_actor.h"
#include "sim/loaders/sdf/sdf_options.h"
#include "sim/loaders/sdf/sdf_sensors.h"
#include "sim/loaders/sdf/sdf_state.h"

namespace scipd::sim {

/// A file, or a text that messages call `file`.
struct SdfSource {
    std::filesystem::path file;
    std::optional<std::string> text = std::nullopt;
};

/// A document as the library will read it: includes name other documents by uri_of().
struct SdfDocument {
    std::filesystem::path file;
    std::string text;
    bool is_relieved_of_all = false;  ///< it held things, but none for a scanner
    std::string model = {};           ///< the name of its first model or robot
    bool is_converted = false;        ///< from a robot: its lines differ from the file's
    std::string robot = {};           ///< the URDF that it was converted from
};

struct SdfSurvey {
    std::vector<SdfDocument> documents;  ///< the source first, then each include once
    std::vector<SdfActor> actors;        ///< of all documents; models hold the index
    SdfState state;                      ///< of the source's first world
    std::vector<std::size_t> order;      ///< of the documents: includes come first
    std::vector<MeshSource> meshes;      ///< that the documents will ask for
    std::vector<std::string> faults;
    std::vector<std::string> warnings;
    double bytes = 0.0;                ///< estimated memory to read everything
    std::vector<FoundSensor> sensors;  ///< of all documents except robots
};

/// Leaves out what cannot be included, with a warning. With `strict` that is a fault, and the
/// documents stay as they are.
SdfSurvey survey_sdf(const SdfSource& source, const Resources& resources,
                     const SdfOptions& options);

}  // namespace scipd::sim
