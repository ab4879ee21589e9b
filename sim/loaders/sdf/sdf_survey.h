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

#include "sim/loaders/mesh/mesh_shelf.h"
#include "sim/loaders/sdf/resources.h"
#include "sim/loaders/sdf/sdf_actor.h"
#include "sim/loaders/sdf/sdf_options.h"
#include "sim/loaders/sdf/sdf_sensors.h"
#include "sim/loaders/sdf/sdf_state.h"

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
    std::string model = {};           ///< what its first model or robot is called
    bool is_converted = false;        ///< of a robot: its lines are no longer the file's
    std::string robot = {};           ///< what it was converted from
};

struct SdfSurvey {
    std::vector<SdfDocument> documents;  ///< the source first, then each include once
    std::vector<SdfActor> actors;        ///< of all documents; their models know which is theirs
    SdfState state;                      ///< of the source's first world
    std::vector<std::size_t> order;      ///< of the documents: none before what it includes
    std::vector<MeshSource> meshes;      ///< that they will ask for
    std::vector<std::string> faults;
    std::vector<std::string> warnings;
    double bytes = 0.0;                ///< that reading all of it takes, about
    std::vector<FoundSensor> sensors;  ///< of all documents but robots
};

/// What cannot be included is left out with a warning; `strict` makes that a fault, and leaves the
/// documents as they are.
SdfSurvey survey_sdf(const SdfSource& source, const Resources& resources,
                     const SdfOptions& options);

}  // namespace scipd::sim
