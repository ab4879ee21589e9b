// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reading one file through libsdformat, and every word that the library has to say about it. Any
// thread: readers wait for each other (sdf_console.h).
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
    sdf::Root root;  ///< complete where there are no faults
    std::vector<std::string> faults;
    std::vector<std::string> warnings;
    std::vector<SdfActor> actors;  ///< models say which is theirs
    std::vector<FoundSensor> sensors;
    SdfState state;
    /// Files that the library was given in place of others, by what it calls them: they are gone.
    std::map<std::string, StandIn> stand_ins;

    /// The file of an element as the user knows it.
    [[nodiscard]] std::filesystem::path file_of(const sdf::ElementPtr& element,
                                                const std::filesystem::path& otherwise) const;
    /// FILE:LINE of an element, as far as the library knows.
    [[nodiscard]] std::string place_of(const sdf::ElementPtr& element,
                                       const std::filesystem::path& otherwise) const;
    /// The library calls package:// of a robot model://.
    [[nodiscard]] std::string uri_as_written(const sdf::ElementPtr& element,
                                             const std::string& uri) const;
};

/// Wants an absolute path. Reads nothing that would take more than this much memory.
SdfFile read_sdf(SdfSurvey survey, const SdfOptions& options);

}  // namespace scipd::sim
