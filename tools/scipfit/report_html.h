// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A fit as a page for people. One thread.
#pragma once

#include <optional>
#include <string>

#include "tools/scipfit/fit.h"
#include "tools/scipfit/room_fit.h"

namespace scipd::tools {

/// One page that needs nothing else, light or dark as its reader has it.
[[nodiscard]] std::string as_html(const Standing& standing, const Fit& fit,
                                  const std::optional<Room>& room);

}  // namespace scipd::tools
