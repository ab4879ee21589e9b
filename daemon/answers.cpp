// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/answers.h"

#include "daemon/models/registry.h"
#include "sim/backends/depth.h"
#include "sim/backends/registry.h"

namespace scipd::daemon {

Answer model_list() {
    std::string text;
    for (const Model& model : models())
        text += describe(model) + "\n";
    return {0, text};
}

Answer backend_list() {
    std::string text;
    for (const auto& backend : sim::backends())
        text += std::string{backend.name} + "  " + std::string{backend.description} + "\n";
    return {0, text};
}

Answer probe() {
    const sim::DepthProbe found = sim::probe_depth();
    return {found.can_draw ? 0 : 1, found.text};
}

}  // namespace scipd::daemon
