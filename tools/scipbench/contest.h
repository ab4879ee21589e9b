// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The methods that the paper's Table 3 compares, each at one resolution. A scan includes everything
// from a pose to ranges. Reads no clock. One thread.
//
//   R      casts rays, which also tells at no cost what object each ray hits
//   RwM    the same, and looks up the material for every ray
//   ZB     draws one picture, a pixel for each ray, reads its depth back and computes ranges
//   ZBwM   the same, and reads the triangle numbers back and looks up the materials
//   exact  the depth backend as scanners use it: all of ZBwM, and it decides edges exactly
//
//   R      rays, through the backend that does so; which object a ray hits comes for free
//   RwM    the same, and the material of every ray looked up
//   ZB     one pass of the depth buffer, a pixel for a ray, depth read back and made ranges
//   ZBwM   the same, and the triangle numbers read back and made materials
//   exact  the depth backend as scanners use it: all of ZBwM, and edges decided exactly
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "sim/backends/range_backend.h"
#include "tools/scipbench/paper.h"
#include "tools/scipbench/pixel_scan.h"

namespace scipd::tools {

enum class Method { rays, rays_with_material, depth, depth_with_material, exact };

inline constexpr std::size_t method_count = 5;
inline constexpr std::array<const char*, method_count> method_names{"R", "RwM", "ZB", "ZBwM",
                                                                    "exact"};

/// The height of the scanner in all tables.
inline constexpr double robot_height_m = 0.3;

class Contest {
  public:
    /// Both backends are of this scene and must outlive this object. If `depth` is null, only the
    /// methods by rays take part.
    Contest(const sim::SharedScene& scene, sim::RangeBackend& rays, sim::RangeBackend* depth,
            const Resolution& resolution);

    [[nodiscard]] bool takes_part(Method method) const;

    /// Scans by a method that takes part.
    void scan(Method method, const sim::Pose& pose);

    /// The latest scan. All methods but `exact` fill the ranges, those with M also the materials.
    [[nodiscard]] const std::vector<float>& range_m() const { return range_m_; }
    [[nodiscard]] const std::vector<sim::MaterialId>& materials() const { return materials_; }

  private:
    void cast_rays(const sim::Pose& pose, bool with_material);
    void draw(const sim::Pose& pose, bool with_material);

    sim::RangeBackend& rays_;
    sim::RangeBackend* depth_;
    std::optional<PixelScan> pixels_;
    std::vector<glm::vec3> directions_;
    std::vector<sim::Hit> hits_;
    std::vector<float> range_m_;
    std::vector<sim::MaterialId> materials_;
};

}  // namespace scipd::tools
