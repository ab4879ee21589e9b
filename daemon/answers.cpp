// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/answers.h"

#include "daemon/models/registry.h"
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
    Answer answer;
    for (const sim::BackendRow& backend : sim::backends()) {
        if (backend.probe == nullptr) continue;
        const sim::BackendProbe found = backend.probe();
        answer.text += found.text;
        if (!found.usable) answer.exit_code = 1;
    }
    return answer;
}

}  // namespace scipd::daemon
