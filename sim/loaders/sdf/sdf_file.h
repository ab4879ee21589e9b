// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads one file through libsdformat, and collects everything that the library reports about it.
// Any thread: readers wait for each other (sdf_console.h).
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <sdf/Root.hh>

#include "sim/loaders/sdf/resources.h"
#include "sim/loaders/sdf/sdf_survey.h"
#include "sim/loaders/sdf/stand_in.h"

namespace scipd::sim {

struct SdfFile {
    sdf::Root root;  ///< complete if there are no faults
    std::vector<std::string> faults;
    std::vector<std::string> warnings;
    std::vector<SdfActor> actors;  ///< the models hold the index (actor_mark)
    std::vector<FoundSensor> sensors;
    SdfState state;
    /// The files that the library read instead of the user's, by the library's name for them. They
    /// no longer exist.
    std::map<std::string, StandIn> stand_ins;

    /// The user's file that holds an element; `otherwise` if the library does not know it.
    [[nodiscard]] std::filesystem::path file_of(const sdf::ElementPtr& element,
                                                const std::filesystem::path& otherwise) const;
    /// FILE:LINE of an element, as far as the library knows.
    [[nodiscard]] std::string place_of(const sdf::ElementPtr& element,
                                       const std::filesystem::path& otherwise) const;
    /// `uri` as the user wrote it: in robots, the library turns package:// into model://.
    [[nodiscard]] std::string uri_as_written(const sdf::ElementPtr& element,
                                             const std::string& uri) const;
};

/// Reads what survey_sdf() prepared. The path of the source must be absolute.
SdfFile read_sdf(SdfSurvey survey, const SdfOptions& options);

}  // namespace scipd::sim
