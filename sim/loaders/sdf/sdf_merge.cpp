// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/sdf_merge.h"

#include <algorithm>
#include <utility>

#include "sim/loaders/parts/frames.h"

namespace scipd::sim {
namespace {

constexpr std::string_view model_frame = "__model__";

/// Makes names that mean the model itself mean the frame that stands for it.
class Redirect {
  public:
    explicit Redirect(const std::string& frame) : frame_(frame) {}

    void part(SdfPart& part) const {
        const bool is_fixed = part.kind == SdfPart::Kind::frame;
        if (is_fixed ? means_model(part.attached_to) : part.attached_to == model_frame) {
            part.attached_to = frame_;
        }
        // A frame or a joint is where it is fixed to, unless it says otherwise.
        const bool is_placed =
            part.kind == SdfPart::Kind::link || part.kind == SdfPart::Kind::model;
        pose(part.pose, is_placed);
        for (SdfSurface& surface : part.surfaces)
            pose(surface.pose, false);
    }

  private:
    static bool means_model(const std::string& name) { return name.empty() || name == model_frame; }

    void pose(GivenPose& given, bool by_default) const {
        if (by_default ? means_model(given.relative_to) : given.relative_to == model_frame) {
            given.relative_to = frame_;
        }
    }

    const std::string& frame_;
};

/// libsdformat calls it so.
SdfPart frame_of(const SdfPart& model, const SdfPart& outer) {
    SdfPart frame{SdfPart::Kind::frame, "_merged__" + model.name + "__model__", model.place,
                  model.pose};
    if (frame.pose.relative_to.empty()) {
        frame.pose.relative_to = outer.kind == SdfPart::Kind::world ? "world" : "__model__";
    }
    const auto link = std::ranges::find(model.parts, SdfPart::Kind::link, &SdfPart::kind);
    if (outer.kind == SdfPart::Kind::model && link != model.parts.end()) {
        frame.attached_to = model.canonical_link.empty() ? link->name : model.canonical_link;
    }
    return frame;
}

}  // namespace

void merge(SdfPart model, SdfPart& outer, std::string& why) {
    SdfPart frame = frame_of(model, outer);
    if (!model.placement_frame.empty()) {
        const auto placed = Frames(model).pose_of(model.placement_frame);
        if (!placed) {
            why = "its placement_frame is " + placed.error().why;
            return;
        }
        frame.pose.pose = frame.pose.pose * inverse(*placed);
    }
    const Redirect redirect(frame.name);
    outer.parts.push_back(frame);
    for (SdfPart& part : model.parts) {
        redirect.part(part);
        outer.parts.push_back(std::move(part));
    }
}

}  // namespace scipd::sim
