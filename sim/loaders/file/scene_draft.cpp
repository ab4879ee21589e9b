// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/file/scene_draft.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "sim/loaders/file/load_error.h"
#include "sim/text/quote.h"
#include "sim/world/anchor.h"

namespace scipd::sim {
namespace {

/// A file of nothing but faults would take more memory for their sentences than for itself.
constexpr std::size_t most_told = 1000;

}  // namespace

SceneDraft::SceneDraft(std::filesystem::path file, bool strict, std::vector<std::string> warnings)
    : file_(std::move(file)), strict_(strict), anything_left_out_(!warnings.empty()) {
    for (auto& warning : warnings)
        warn(warning);
}

ModelId SceneDraft::add(Model model) {
    scene_.models.push_back(std::move(model));
    return static_cast<ModelId>(scene_.models.size() - 1);
}

void SceneDraft::drop_if_bare(ModelId last) {
    const bool has_object = !scene_.objects.empty() && scene_.objects.back().model >= last;
    const bool has_frame = !scene_.frames.empty() && scene_.frames.back().model >= last;
    if (!has_object && !has_frame) scene_.models.resize(last);
}

void SceneDraft::add(Object object, const Material& material) {
    object.material = id_of(material, scene_.materials);
    scene_.objects.push_back(std::move(object));
}

void SceneDraft::warn(const std::string& text) {
    if (warnings_.size() >= most_told) {
        ++more_;
    } else if (std::string told = shown(text); told_.insert(told).second) {
        warnings_.push_back(std::move(told));
    }
}

void SceneDraft::leave_out(const std::string& why) {
    anything_left_out_ = true;
    if (strict_) {
        refuse(why);
    } else {
        warn(why + (why.ends_with('?') ? " It is left out" : "; left out"));
    }
}

void SceneDraft::pass_over(const std::string& why) {
    anything_left_out_ = true;
    warn(why);
}

void SceneDraft::refuse(const std::string& why) {
    if (faults_.size() < most_told) faults_.push_back(shown(why));
}

LoadedScene SceneDraft::finish(const std::string& what_is_seen) && {
    if (more_ > 0) {
        warnings_.push_back(file_.string() + ": has " + std::to_string(more_) +
                            " more warnings, which are not shown");
    }
    if (scene_.objects.empty() && faults_.empty()) {
        warn(file_.string() + ": holds nothing that a scanner could see; give a model a " +
             what_is_seen + " with a box, cylinder, sphere, plane or mesh");
        // The scene is empty because of what was left out, so those warnings become faults.
        if (anything_left_out_) faults_ = warnings_;
    } else if (scene_.objects.empty() && anything_left_out_) {
        faults_.insert(faults_.begin(), warnings_.begin(), warnings_.end());
    }
    if (!faults_.empty()) throw LoadError(std::move(faults_));
    // Every scene gets an anchor, not only those far out: floats are finest around zero.
    scene_.anchor_m = anchor_of(scene_);
    return {std::make_shared<const Scene>(std::move(scene_)), std::move(warnings_)};
}

}  // namespace scipd::sim
