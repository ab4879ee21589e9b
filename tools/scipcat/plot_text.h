// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <string>

namespace scipd::tools {

/// The words around a plot.
struct PlotText {
    std::string title;
    std::string scanner;  ///< which scanner
    std::string scan;     ///< when it was taken, and which part of it
};

}  // namespace scipd::tools
