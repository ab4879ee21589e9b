// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What has to be drawn for a fan, and where in the picture each of its beams looks: one set of
// strips for each run of equal poses, side by side in a picture that is read back at once, or in
// several where they are too many for one.
// Sensors cast the same fan over and over, so a plan is kept as long as it fits. Pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "sim/backends/depth_options.h"
#include "sim/backends/depth_projection.h"
#include "sim/backends/fan.h"

namespace scipd::sim {

/// Where one beam looks.
struct Look {
    std::uint32_t ray = 0;    ///< index into the fan's directions
    std::uint32_t pixel = 0;  ///< in the picture: the one before it to the right and below
    glm::vec2 share{0.0F};    ///< of the way to the next pixel leftward and upward; 0: not on it
    float cos_alpha = 1.0F;
};

struct PlannedView {
    Strip strip;
    std::size_t pose = 0;  ///< index into the fan's poses
    glm::ivec2 corner_px{0, 0};
    std::size_t first_look = 0;
    std::size_t look_count = 0;
};

/// Some views, drawn and read back in one go.
struct PlannedPicture {
    glm::ivec2 size_px{0, 0};
    std::size_t first_view = 0;
    std::size_t view_count = 0;
};

class DepthPlan {
  public:
    DepthPlan() = default;
    DepthPlan(const Fan& fan, const DepthOptions& options);

    /// Whether it was made for these directions and changes of pose.
    [[nodiscard]] bool fits(const Fan& fan) const;

    [[nodiscard]] std::span<const PlannedPicture> pictures() const { return pictures_; }
    [[nodiscard]] std::span<const PlannedView> views() const { return views_; }
    [[nodiscard]] std::span<const PlannedView> views_of(const PlannedPicture& picture) const {
        return views().subspan(picture.first_view, picture.view_count);
    }
    [[nodiscard]] std::span<const Look> looks_of(const PlannedView& view) const {
        return std::span{looks_}.subspan(view.first_look, view.look_count);
    }

  private:
    void place_views();

    std::vector<glm::vec3> directions_;
    std::vector<std::uint32_t> run_begins_;
    std::vector<PlannedPicture> pictures_;
    std::vector<PlannedView> views_;
    std::vector<Look> looks_;
};

}  // namespace scipd::sim
