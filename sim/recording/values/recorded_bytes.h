// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Bytes of a conversation with a scanner, as they were on the wire. What they say is not known
// here. A value; no thread rule.
#pragma once

#include <string>

#include "sim/recording/values/recorded_scan.h"

namespace scipd::sim {

enum class Way { to_scanner, from_scanner };

struct RecordedBytes {
    Way way = Way::from_scanner;
    HostTime host_time{};  ///< when the recorder sent or got them
    std::string bytes;

    bool operator==(const RecordedBytes&) const = default;
};

}  // namespace scipd::sim
