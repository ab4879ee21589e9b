// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/actor_model.h"

#include <charconv>
#include <string>

#include <glm/geometric.hpp>
#include <sdf/Element.hh>

#include "sim/loaders/sdf/sdf_place.h"

namespace scipd::sim {
namespace {

bool are_one_place(const Pose& a, const Pose& b) {
    return glm::distance(a.translation_m, b.translation_m) < 1e-3 &&
           angle_between_rad(a.rotation, b.rotation) < 1e-3;
}

}  // namespace

const SdfActor* actor_of(const sdf::Model& model, const std::vector<SdfActor>& actors) {
    if (!model.Element() || !model.Element()->HasElement(actor_mark)) return nullptr;
    const auto text = model.Element()->GetElement(actor_mark)->Get<std::string>();
    std::size_t index = actors.size();
    std::from_chars(text.data(), text.data() + text.size(), index);
    return index < actors.size() ? &actors[index] : nullptr;
}

Model walking(Model still, const SdfActor& actor, const sdf::Model& model) {
    still.movable = true;
    if (actor.script == nullptr) return still;
    const Pose put = to_pose(model.RawPose());  // before a saved <state> moves it
    still.script = are_one_place(put, actor.pose) ? actor.script : moved(put, *actor.script);
    still.world_from_model = still.script->steps.front().pose;
    return still;
}

}  // namespace scipd::sim
