// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/broker/shared_edits.h"

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <variant>

#include <spdlog/spdlog.h>

#include "daemon/broker/model_message.h"

namespace scipd::daemon {
namespace {

using Result = EditOutcome::Result;

std::string model_of(const SceneEdit& edit) {
    if (const auto* const add = std::get_if<AddModel>(&edit)) return add->placement.name;
    if (const auto* const remove = std::get_if<RemoveModel>(&edit)) return remove->name;
    return {};
}

std::string joined(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines)
        text += (text.empty() ? "" : "; ") + line;
    return text;
}

}  // namespace

std::vector<SceneEdit> SharedEdits::edits_for(const sim::Scene& base, const Texts& kept) {
    std::vector<SceneEdit> edits;
    for (const auto& [model, text] : kept) {
        auto edit = parse_model_message(model, text);
        if (!edit) {
            throw std::runtime_error("the broker keeps a model that cannot be added, " + model +
                                     ": " + edit.error().why);
        }
        const bool is_gone = std::holds_alternative<RemoveModel>(*edit);
        if (!is_gone || sim::find_model(base, model)) edits.push_back(*std::move(edit));
    }
    return edits;
}

void SharedEdits::begin(const sim::Scene& base, const Texts& kept) {
    for (const sim::Model& model : base.models)
        base_.insert(model.name);
    wanted_ = kept;
}

std::string SharedEdits::text_of_edit(const SceneEdit& edit) const {
    if (const auto* const add = std::get_if<AddModel>(&edit)) return text_of(*add);
    return base_.contains(model_of(edit)) ? std::string(gone) : std::string{};
}

void SharedEdits::edit(SceneEdit edit, EditDone done) {
    if (std::holds_alternative<LoadWorld>(edit)) {
        return done({Result::forbidden,
                     {"the world is shared with other daemons; start all of them with another "
                      "scene instead"}});
    }
    if (std::holds_alternative<SetMaterial>(edit)) {
        return done({Result::not_now,
                     {"the world is shared with other daemons, which are told of whole models; add "
                      "the model again, with another material"}});
    }
    if (!link_.connected()) {
        return done({Result::not_now,
                     {"the world is shared, and the broker is not there: " + link_.trouble() +
                      "; try again when it is back"}});
    }
    const std::string model = model_of(edit);
    const std::string text = text_of_edit(edit);
    const std::string before = wanted_[model];
    wanted_[model] = text;
    hooks_.edit(std::move(edit),
                [this, model, text, before, done = std::move(done)](const EditOutcome& outcome) {
                    if (outcome.result == Result::done) {
                        hooks_.changed(model);
                        publish(model, text);
                    } else if (wanted_[model] == text) {
                        wanted_[model] = before;
                    }
                    done(outcome);
                });
}

// What was told here comes back, and is known then.
void SharedEdits::take(const std::string& model, const std::string& text) {
    // Whoever comes later would not know that a model of the base world is gone.
    if (text.empty() && base_.contains(model)) return publish(model, std::string(gone));
    const auto known = wanted_.find(model);
    if ((known == wanted_.end() ? "" : known->second) == text) return;
    want(model, text);
}

void SharedEdits::want(const std::string& model, const std::string& text) {
    auto edit = parse_model_message(model, text);
    if (!edit) return settle(model, {Result::faulty, {edit.error().why}});
    wanted_[model] = text;
    hooks_.edit(*std::move(edit), [this, model](const EditOutcome& outcome) {
        if (outcome.result == Result::done) hooks_.changed(model);
        settle(model, outcome);
    });
}

void SharedEdits::settle(const std::string& model, const EditOutcome& outcome) {
    const bool as_wanted = outcome.result == Result::done || outcome.result == Result::unknown;
    if (as_wanted) {
        failed_.erase(model);
    } else {
        failed_[model] = joined(outcome.messages);
        spdlog::error("the world differs from that of the other daemons: model {}: {}", model,
                      failed_[model]);
    }
    hooks_.differs(failed_.empty() ? "" : failed_.begin()->first + ": " + failed_.begin()->second);
}

void SharedEdits::take_all(const Texts& kept) {
    for (const auto& [model, text] : Texts(wanted_)) {
        if (!kept.contains(model) && !text.empty() && !base_.contains(model)) want(model, "");
    }
    for (const auto& [model, text] : kept)
        take(model, text);
}

void SharedEdits::say_all() {
    for (const auto& [model, text] : wanted_) {
        if (!text.empty()) publish(model, text);
    }
}

void SharedEdits::publish(const std::string& model, const std::string& text) {
    link_.publish(topics_.of(Topic::Kind::model, model), text, {.surely = true, .kept = true});
}

}  // namespace scipd::daemon
