// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A comparison as people and programs read it. Any thread; nothing shared.
#pragma once

#include <string>

#include "tools/scipcat/compare/comparison.h"

namespace scipd::tools::comparing {

[[nodiscard]] std::string as_text(const Comparison& comparison);
[[nodiscard]] std::string as_json(const Comparison& comparison);
/// One page that needs nothing else, light or dark as its reader has it.
[[nodiscard]] std::string as_html(const Comparison& comparison);

}  // namespace scipd::tools::comparing
