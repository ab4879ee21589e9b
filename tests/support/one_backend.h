// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Backends for tests that do not care which: every sensor casts rays.
#pragma once

#include <string>
#include <vector>

#include "daemon/world/backend_maker.h"

namespace scipd::daemon {

inline SensorBackends one_backend(const sim::SharedScene& scene,
                                  const std::vector<std::string>& sensors = {"robot/scanner"}) {
    std::vector<RequestedBackend> requests;
    for (const std::string& sensor : sensors)
        requests.push_back({.sensor = sensor, .backend = "embree"});
    return make_backends(requests, scene);
}

}  // namespace scipd::daemon
