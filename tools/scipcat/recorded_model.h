// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The model that a recorded scan is of, where its recording does not say it, as a table of ranges.
// Any thread.
#pragma once

#include <string>

#include "tools/scipcat/plot_subject.h"

namespace scipd::tools {

/// The scan looks where the model's steps do, and its limits are the model's, as far as the
/// recording says nothing else: as `scipd --replay --model` takes it. Throws WrongInput where there
/// is no such model, or the scan has not as many values as the model has steps.
void take_for_model(PlotSubject& subject, const std::string& model);

}  // namespace scipd::tools
