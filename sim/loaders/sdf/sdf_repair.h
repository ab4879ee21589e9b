// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What libsdformat has against a document, taken out of it: the library refuses a whole world for
// one size that is no number. Any thread; nothing shared.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <sdf/Error.hh>
#include <sdf/Types.hh>

#include "sim/loaders/sdf/sdf_survey.h"

namespace scipd::sim {

/// Without those that only say once more that there was one; all where there are no others.
std::vector<sdf::Error> without_echoes(const sdf::Errors& errors);

/// Takes out whatever each error is about: a visual, a link or a model, or less where that is
/// nothing to shape and place. Answers with a warning for each; none where it cannot tell.
std::vector<std::string> take_out(const sdf::Errors& errors, SdfDocument& document);

/// Takes out of a world what the library has read before it came to the error.
void drop_read(const sdf::Error& error, SdfDocument& document);

/// Takes out the models of a world that have a fault each alone, which `fault_of` a text tells.
std::vector<std::string> take_out_models(
    SdfDocument& document, const std::function<std::string(const std::string&)>& fault_of);

/// Takes out what includes the document of this URI.
void take_out_includes(SdfDocument& document, const std::string& uri);

}  // namespace scipd::sim
