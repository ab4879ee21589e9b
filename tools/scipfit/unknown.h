// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a recording cannot tell. It has no number anywhere. A value; no thread rule.
#pragma once

#include <string>
#include <vector>

namespace scipd::tools {

struct Unknown {
    std::string parameter;
    std::string why;
    std::string would_tell;  ///< what to record or to measure
};

using Unknowns = std::vector<Unknown>;

}  // namespace scipd::tools
