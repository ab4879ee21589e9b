// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What `scipd --list-models` prints. docs/make_models.py reads it. Any thread; nothing shared.
#pragma once

#include <span>
#include <string>

#include "daemon/models/model.h"

namespace scipd::daemon {

/// MODEL@FIRMWARE.
[[nodiscard]] std::string listed_name(const Model& model);
/// "USB, RS-232"
[[nodiscard]] std::string links_of(const protocol::DeviceProfile& profile);
/// Three tables of at most 100 columns, a model a row: figures, commands, and how each is known.
[[nodiscard]] std::string list_of(std::span<const Model> models);

}  // namespace scipd::daemon
