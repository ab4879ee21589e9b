// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/fleet/shared_edits.h"

#include <utility>
#include <variant>

#include "daemon/fleet/model_message.h"

namespace scipd::daemon {
namespace {

using Result = EditOutcome::Result;

}  // namespace

std::vector<SceneEdit> SharedEdits::edits_for(const sim::Scene& base, const Texts& kept) {
    std::vector<SceneEdit> edits;
    for (const auto& [model, text] : kept) {
        auto edit = parse_model_message(model, text);
        if (!edit) continue;
        const bool is_gone = std::holds_alternative<RemoveModel>(*edit);
        if (!is_gone || sim::find_model(base, model)) edits.push_back(*std::move(edit));
    }
    return edits;
}

void SharedEdits::begin(const sim::Scene& base, const Texts& kept) {
    for (const sim::Model& model : base.models)
        base_.insert(model.name);
    for (const auto& [model, text] : kept) {
        const auto edit = parse_model_message(model, text);
        if (edit) {
            wanted_[model] = text;
        } else {
            settle(model, text, {Result::faulty, {edit.error().why}});
        }
    }
}

void SharedEdits::differ(const std::map<std::string, std::string>& why) {
    for (const auto& [model, reason] : why) {
        const auto wanted = wanted_.extract(model);
        if (wanted) settle(model, wanted.mapped(), {Result::faulty, {reason}});
    }
}

void SharedEdits::try_again() {
    for (const auto& [model, text] : Texts(failed_))
        want(model, text);
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
    const std::string before = std::exchange(wanted_[model], text);
    hooks_.edit(std::move(edit),
                [this, model, text, before, done = std::move(done)](const EditOutcome& outcome) {
                    if (outcome.result == Result::done) {
                        hooks_.changed(model);
                        publish(model, text);
                    } else {
                        put_back(model, text, before);
                    }
                    done(outcome);
                });
}

// An empty text would take a model of the base world away when that is loaded again.
void SharedEdits::put_back(const std::string& model, const std::string& text,
                           const std::string& before) {
    if (wanted_[model] == text) wanted_[model] = before;
    if (wanted_[model].empty()) wanted_.erase(model);
}

// What was told here comes back, and is known then.
void SharedEdits::take(const std::string& model, const std::string& text) {
    const auto known = wanted_.find(model);
    const std::string have = known == wanted_.end() ? "" : known->second;
    const bool never_took = have.empty() && failed_.contains(model);
    // Whoever comes later would not know that a model of the base world is gone. Where what was
    // said of it could not be made, it stands as it did before, and goes on to.
    if (text.empty() && base_.contains(model) && !never_took)
        return publish(model, std::string(gone));
    if (have == text) return settle(model, text, {Result::done, {}});
    want(model, text);
}

void SharedEdits::want(const std::string& model, const std::string& text) {
    auto edit = parse_model_message(model, text);
    if (!edit) return settle(model, text, {Result::faulty, {edit.error().why}});
    const std::string before = std::exchange(wanted_[model], text);
    hooks_.edit(*std::move(edit), [this, model, text, before](const EditOutcome& outcome) {
        if (outcome.result == Result::done) hooks_.changed(model);
        settle(model, text, outcome);
        if (failed_.contains(model)) put_back(model, text, before);
    });
}

void SharedEdits::settle(const std::string& model, const std::string& text,
                         const EditOutcome& outcome) {
    const bool as_wanted = outcome.result == Result::done || outcome.result == Result::unknown;
    if (as_wanted) {
        failed_.erase(model);
    } else {
        failed_[model] = text;
    }
    hooks_.differs(model, as_wanted ? "" : in_one_line(outcome.messages));
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
