// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <string>

namespace scipd::tools {

/// The words around a plot.
struct PlotText {
    std::string title;
    std::string scanner;  ///< which one
    std::string scan;     ///< when, and how much of it
};

}  // namespace scipd::tools
