// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Takes out of a document what libsdformat refuses. The library refuses a whole world for one size
// that is not a number. Any thread; nothing shared.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <sdf/Error.hh>
#include <sdf/Types.hh>

#include "sim/loaders/sdf/sdf_survey.h"

namespace scipd::sim {

/// The errors without those that only repeat that there was one; all of them if there are no
/// others.
std::vector<sdf::Error> without_echoes(const sdf::Errors& errors);

/// Takes out what each error is about: a visual, a link or a model, or only a smaller element if
/// that affects neither shape nor pose. Returns a warning for each; none if it cannot find the
/// element.
std::vector<std::string> take_out(const sdf::Errors& errors, SdfDocument& document);

/// Takes out the models of a world that the library read before the one with the error.
void drop_read(const sdf::Error& error, SdfDocument& document);

/// Takes out each model of a world that has a fault even when it is loaded alone. `fault_of`
/// returns the fault of a text; empty if it has none.
std::vector<std::string> take_out_models(
    SdfDocument& document, const std::function<std::string(const std::string&)>& fault_of);

/// Takes out every <include> of this URI.
void take_out_includes(SdfDocument& document, const std::string& uri);

}  // namespace scipd::sim
