// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/scene_draft.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "sim/loaders/file/load_error.h"
#include "sim/world/anchor.h"

namespace scipd::sim {

SceneDraft::SceneDraft(std::filesystem::path file, bool strict, std::vector<std::string> warnings)
    : file_(std::move(file)), strict_(strict), anything_left_out_(!warnings.empty()) {
    for (auto& warning : warnings)
        warn(std::move(warning));
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

void SceneDraft::warn(std::string text) {
    if (told_.insert(text).second) warnings_.push_back(std::move(text));
}

void SceneDraft::leave_out(const std::string& why) {
    anything_left_out_ = true;
    if (strict_) {
        faults_.push_back(why);
    } else {
        warn(why + (why.ends_with('?') ? " It is left out" : "; left out"));
    }
}

void SceneDraft::pass_over(std::string why) {
    anything_left_out_ = true;
    warn(std::move(why));
}

LoadedScene SceneDraft::finish(const std::string& what_is_seen) && {
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
