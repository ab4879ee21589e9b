// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The oracle: every ray against every object in plain double arithmetic, shapes as formulas and not
// as triangles. Made to be right and readable, not to be quick.
#pragma once

#include <memory>
#include <string_view>

#include "sim/backends/range_backend.h"

namespace scipd::sim {

[[nodiscard]] std::string_view reference_description();

std::unique_ptr<RangeBackend> make_reference_backend(SharedScene scene);

}  // namespace scipd::sim
