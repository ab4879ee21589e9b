// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <string>

namespace scipd::sim {
struct Scan;
}

namespace scipd::daemon {

/// What a sensor has met, before anything is made of it. A view, for as long as the call.
struct Cast {
    const std::string& robot;
    const std::string& sensor;
    const sim::Scan& scan;
    bool looks_around;  ///< half a turn and more
};

}  // namespace scipd::daemon
