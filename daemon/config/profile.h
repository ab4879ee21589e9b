// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The fields of a model as a user writes them, under a sensor's `profile:` or in a model of the
// file's own: the members of protocol::DeviceProfile by their names, and `noise`. Any thread;
// nothing shared.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "daemon/config/section.h"
#include "daemon/models/model.h"

namespace scipd::daemon {

/// All members but name and release, which say what model it is.
std::vector<std::string_view> profile_keys();
/// Of `codes` and of `scip1`.
std::vector<std::string_view> code_keys();
std::vector<std::string_view> scip1_keys();

/// A map with fields of a profile, and with these keys besides.
Section profile_section(const Field& map, std::span<const std::string_view> besides,
                        Faults& faults);

/// What the section gives takes the place of what the model has; the optics follow. Then all must
/// go together; without a model only each value by itself is looked at.
void override_model(const Section& section, const Field& map, std::optional<Model>& model,
                    Faults& faults);

}  // namespace scipd::daemon
