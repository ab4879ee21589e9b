// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Poses as the control API has them: xyz, and q as x, y, z, w. No thread rule.
#pragma once

#include "testing/scipd_values.h"

namespace scipd::testing {

[[nodiscard]] Json json_of(const Pose& pose);
[[nodiscard]] Pose pose_in(const Json& json);
/// On the straight and even way from one to the other; `share` is from 0 to 1.
[[nodiscard]] Json between(const Json& from, const Json& to, double share);

}  // namespace scipd::testing
