// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How often requests were answered with which status. A value; one thread.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

namespace scipd::protocol {

/// By the status as it was sent: two characters, or one in SCIP 1.1.
using StatusCounts = std::map<std::string, std::uint64_t, std::less<>>;

}  // namespace scipd::protocol
