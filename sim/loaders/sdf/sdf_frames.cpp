// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/sdf_frames.h"

#include <optional>

#include <sdf/Element.hh>
#include <sdf/Frame.hh>

#include "sim/world/reach.h"

namespace scipd::sim {
namespace {

/// The sensor that a frame stands for; null if none.
const FoundSensor* sensor_at(const sdf::Frame& frame, const std::vector<FoundSensor>& found) {
    const auto element = frame.Element();
    if (!element || !element->HasElement(sensor_mark)) return nullptr;
    const auto index = element->Get<std::size_t>(sensor_mark, found.size()).first;
    return index < found.size() ? &found[index] : nullptr;
}

/// Nothing if the frame cannot be resolved.
std::optional<Place> place_of(const sdf::Frame& frame, const ModelPlaces& places) {
    std::string body;
    const bool attached = frame.ResolveAttachedToBody(body).empty();
    const auto link = attached ? places.links.find(body) : places.links.end();
    const bool on_link = link != places.links.end();
    ignition::math::Pose3d resolved;
    if (!frame.SemanticPose().Resolve(resolved, on_link ? body : "__model__").empty()) return {};
    const Place here = (on_link ? link->second : places.model) * to_pose(resolved);
    if (!plausible_position(here.world_from_here.translation_m)) return {};
    return here;
}

}  // namespace

std::vector<Frame> frames_of(const sdf::Model& model, const ModelPlaces& places,
                             const std::string& name, const std::vector<FoundSensor>& found) {
    std::vector<Frame> frames;
    for (std::uint64_t i = 0; i < model.FrameCount(); ++i) {
        const auto& frame = *model.FrameByIndex(i);
        const auto here = place_of(frame, places);
        if (!here) continue;
        frames.push_back({name + "::" + frame.Name(), here->body, here->body_from_here, {}, {}});
        if (const auto* sensor = sensor_at(frame, found)) {
            frames.back().sensor = sensor->type;
            frames.back().lidar = sensor->lidar;
        }
    }
    return frames;
}

}  // namespace scipd::sim
