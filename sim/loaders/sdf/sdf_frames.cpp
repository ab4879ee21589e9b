// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/sdf_frames.h"

#include <sdf/Element.hh>
#include <sdf/Frame.hh>

#include "sim/world/reach.h"

namespace scipd::sim {
namespace {

/// Null where the frame stands for none.
const FoundSensor* sensor_at(const sdf::Frame& frame, const std::vector<FoundSensor>& found) {
    const auto element = frame.Element();
    if (!element || !element->HasElement(sensor_mark)) return nullptr;
    const auto index = element->Get<std::size_t>(sensor_mark, found.size()).first;
    return index < found.size() ? &found[index] : nullptr;
}

}  // namespace

std::vector<Frame> frames_of(const sdf::Model& model, const Place& place, const std::string& name,
                             const std::vector<FoundSensor>& found) {
    std::vector<Frame> frames;
    for (std::uint64_t i = 0; i < model.FrameCount(); ++i) {
        const auto& frame = *model.FrameByIndex(i);
        ignition::math::Pose3d resolved;
        if (!frame.SemanticPose().Resolve(resolved, "__model__").empty()) continue;
        const Place here = place * to_pose(resolved);
        if (!plausible_position(here.world_from_here.translation_m)) continue;
        frames.push_back({name + "::" + frame.Name(), here.body, here.body_from_here, {}, {}});
        if (const auto* sensor = sensor_at(frame, found)) {
            frames.back().sensor = sensor->type;
            frames.back().lidar = sensor->lidar;
        }
    }
    return frames;
}

}  // namespace scipd::sim
