// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The models that the sensors of a configuration may name: those of the registry, and those that
// the configuration defines under `models:`. Each of these is like one of the registry, except for
// what the configuration says of it. One thread at a time.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "daemon/models/model.h"
#include "sim/loaders/yaml/yaml_section.h"

namespace scipd::daemon {

class ModelChoice {
  public:
    /// `models` is the root key; null where there is none.
    ModelChoice(const sim::YamlField* models, sim::YamlFaults& faults);

    /// Nothing where it is one of the file's own that has faults, which have been told already.
    [[nodiscard]] sim::Expected<std::optional<Model>> find(const std::string& name) const;

  private:
    static std::optional<Model> read_own(const sim::YamlField& field, sim::YamlFaults& faults);
    [[nodiscard]] std::string own_names() const;

    std::map<std::string, std::optional<Model>> own_;
};

}  // namespace scipd::daemon
