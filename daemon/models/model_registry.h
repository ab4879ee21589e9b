// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// All products that scipd can emulate, by name. No other file lists them all.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "daemon/models/model.h"
#include "sim/expected.h"

namespace scipd::daemon {

/// All models, each with the firmware from which its texts were recorded.
const std::vector<Model>& models();

/// The model that a user has named, as MODEL or MODEL@FIRMWARE, which is how `scipd --list-models`
/// prints them. A fault tells the choices.
sim::Expected<Model> model_named(std::string_view name);

/// The model of a name that must be right. Throws std::invalid_argument where it is not.
const Model& find_model(std::string_view name);

}  // namespace scipd::daemon
