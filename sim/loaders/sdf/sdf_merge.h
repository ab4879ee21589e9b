// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// <include merge='true'>: the parts of a model become parts of what includes it. Any thread.
#pragma once

#include "sim/loaders/parts/part.h"

namespace scipd::sim {

/// Puts the parts of `model` into `outer`, and a frame that stands for the model. `why` is filled
/// if its placement frame is none; then nothing is merged.
void merge(SdfPart model, SdfPart& outer, std::string& why);

}  // namespace scipd::sim
