// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/program/answers.h"

#include "daemon/command_line/completions.h"
#include "daemon/models/model_list.h"
#include "daemon/models/model_registry.h"
#include "sim/backends/registry.h"

namespace scipd::daemon {

Answer model_list() {
    return {0, list_of(models())};
}

Answer backend_list() {
    std::string text;
    for (const auto& backend : sim::backends())
        text += std::string{backend.name} + "  " + std::string{backend.description} + "\n";
    return {0, text};
}

Answer completion_script(const CLI::App& app, const std::string& shell) {
    std::string model_names;
    std::string last;
    for (const Model& model : models()) {
        if (model.profile.name == last) continue;
        last = model.profile.name;
        model_names += (model_names.empty() ? "" : " ") + last;
    }
    std::string backend_names = "auto";
    for (const auto& backend : sim::backends())
        backend_names += " " + std::string{backend.name};
    return {0, completions(app, shell, {{"/--model", model_names}, {"/--backend", backend_names}})};
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
