// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// All products that scipd can emulate, by name. No other file lists them all.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "daemon/models/model.h"

namespace scipd::daemon {

/// All models, each with the firmware from which its texts were recorded.
const std::vector<Model>& models();

/// MODEL or MODEL@FIRMWARE, as `scipd --list-models` prints them. Throws std::invalid_argument,
/// naming the choices.
const Model& find_model(std::string_view name);

}  // namespace scipd::daemon
