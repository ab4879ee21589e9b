// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Names of parts: each must have one that no other part of its model has. Any thread.
#pragma once

#include <string>
#include <vector>

#include "sim/loaders/file/scene_draft.h"
#include "sim/loaders/parts/part.h"

namespace scipd::sim {

/// OUTER::INNER
std::string path_of(const std::vector<std::string>& names);

/// Gives a name to parts that have none, and another one to those whose name is taken. The draft is
/// told. `outer` are the names around them.
void mend_names(std::vector<SdfPart>& parts, const std::vector<std::string>& outer,
                SceneDraft& draft);
/// Mends the names of the surfaces of a link; `kind` is their element.
void mend_names(std::vector<SdfSurface>& surfaces, const std::vector<std::string>& outer,
                const std::string& kind, SceneDraft& draft);

}  // namespace scipd::sim
