// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where the parts of a model lie in it, or the models of a world in that, by the rules of SDF 1.12:
// `relative_to`, `attached_to`, `placement_frame`, the frames of joints, and OUTER::INNER for what
// lies in nested models. One thread; it must not outlive the part.
#pragma once

#include <map>
#include <memory>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "sim/expected.h"
#include "sim/loaders/parts/part.h"

namespace scipd::sim {

class Frames {
  public:
    /// The frames in a model or a world.
    explicit Frames(const SdfPart& outer);

    /// The pose of one of its own parts, in its frame. Else the reason why nobody knows.
    [[nodiscard]] Expected<Pose> pose_of(const SdfPart& part);
    /// The pose of the frame of this name.
    [[nodiscard]] Expected<Pose> pose_of(std::string_view name);
    /// A pose that a part of `link` gives, in the frame of the link.
    [[nodiscard]] Expected<Pose> in_link(const SdfPart& link, const GivenPose& given);
    /// The link of its own that a frame is fixed to, through others; null if it is another body.
    [[nodiscard]] const SdfPart* link_under(const SdfPart& frame) const;

  private:
    [[nodiscard]] const SdfPart* find(std::string_view name) const;
    /// The nested model that a name leads into, and the rest of the name; null if into none.
    [[nodiscard]] std::pair<const SdfPart*, std::string_view> into_model(
        std::string_view name) const;
    [[nodiscard]] Frames& nested(const SdfPart& model);
    [[nodiscard]] bool is_there(std::string_view name);
    /// The part of its own that the pose of this one leads to first; null if to none.
    [[nodiscard]] const SdfPart* next_of(const SdfPart& part) const;
    [[nodiscard]] Expected<Pose> found(const SdfPart& part);
    [[nodiscard]] Expected<Pose> placed(const SdfPart& part);
    [[nodiscard]] bool is_itself(std::string_view name) const;

    const SdfPart& outer_;
    std::unordered_map<std::string_view, const SdfPart*> parts_;
    std::unordered_map<const SdfPart*, Expected<Pose>> known_;
    std::map<const SdfPart*, std::unique_ptr<Frames>> nested_;
};

}  // namespace scipd::sim
