// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/compare/comparison_report.h"
namespace scipd::tools::comparing {
std::string as_html(const Comparison& comparison) { return as_text(comparison); }
}
