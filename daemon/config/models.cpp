// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/config/models.h"

#include <algorithm>
#include <array>

#include "daemon/config/profile.h"
#include "daemon/config/values.h"
#include "daemon/models/model_registry.h"

namespace scipd::daemon {
namespace {

constexpr std::array<std::string_view, 1> like_key{"like"};

sim::Expected<std::string> parse_own_name(const std::string& text) {
    const bool hides = std::ranges::any_of(
        models(), [&](const Model& model) { return model.profile.name == text; });
    if (hides) return sim::refuse("is a model of scipd's own; use another name");
    return parse_name(text);
}

}  // namespace

ModelChoice::ModelChoice(const sim::YamlField* models, sim::YamlFaults& faults) {
    if (!models) return;
    for (const sim::YamlField& field : entries(*models, faults))
        own_[field.key] = read_own(field, faults);
}

std::optional<Model> ModelChoice::read_own(const sim::YamlField& field, sim::YamlFaults& faults) {
    const std::size_t faults_before = faults.count();
    const sim::YamlSection section = profile_section(field, like_key, faults);
    std::optional<Model> model;
    section.read("like", model, parse_model);
    if (field.value.IsMap() && !section.find("like")) {
        faults.add(field,
                   "needs like, the model that all else is taken from, such as `like: UST-10LX`");
    }
    override_model(section, field, model, faults);
    std::string name;
    faults.take(field, parse_own_name(field.key), name);
    if (model) model->profile.name = name;
    if (faults.count() > faults_before) model.reset();
    return model;
}

sim::Expected<std::optional<Model>> ModelChoice::find(const std::string& name) const {
    if (const auto own = own_.find(name); own != own_.end()) return own->second;
    const auto model = parse_model(name);
    if (model || own_.empty()) return model;
    return sim::refuse(model.error().why + "; this file defines " + own_names());
}

std::string ModelChoice::own_names() const {
    std::string text;
    for (const auto& [name, model] : own_)
        text += (text.empty() ? "" : ", ") + name;
    return text;
}

}  // namespace scipd::daemon
