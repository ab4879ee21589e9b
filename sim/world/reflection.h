// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How much of a scanner's light a face sends back to the scanner, by the angle of incidence. The
// light comes from where the receiver is, so one angle tells everything. Tabulated, since it is
// looked up for every ray. Values; any thread.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "sim/world/surface.h"

namespace scipd::sim {

/// The share that shows the scene as a mirror does: none where the face is not smooth.
[[nodiscard]] float mirrored_share(const Surface& surface);
/// How much brighter a perfect retro-reflector is than a perfect matt face.
[[nodiscard]] double retro_gain();

class Reflection {
  public:
    explicit Reflection(const Surface& surface);

    /// Relative to a white Lambertian face that is met head-on: the cosine of the incidence for a
    /// white matt face, hundreds for a reflector. Between the table's entries it is linear. Without
    /// the highlight of a smooth face.
    [[nodiscard]] float returned(float cos_incidence) const {
        const float x = std::sqrt(std::max(0.0F, 1.0F - cos_incidence)) * float(intervals);
        const auto before = static_cast<std::size_t>(std::min(x, float(intervals)));
        const float share = x - float(before);
        return table_[before] + share * (table_[before + 1] - table_[before]);
    }
    /// What a smooth face throws back as a mirror does, if the light and the lens that it comes
    /// back to blur it by this much: see highlight_gloss().
    [[nodiscard]] float highlight(float cos_incidence, double blur_rad2) const;
    [[nodiscard]] const Surface& surface() const { return surface_; }
    [[nodiscard]] float mirrored() const { return mirrored_share(surface_); }
    /// Whether its lobe is narrower than a beam, so that rays cannot stand for it.
    [[nodiscard]] bool smooth() const { return smooth_; }

  private:
    static constexpr std::size_t intervals = 1024;

    Surface surface_;
    bool smooth_;
    std::array<float, intervals + 2> table_;  ///< over sqrt(1 - cos), and the last one twice
};

/// The exponent of the lobe that a scanner sees of a smooth face. All that blurs it adds up as
/// variances, that of Phong's lobe being 1 / gloss in the direction of the mirrored light.
[[nodiscard]] constexpr double highlight_gloss(double gloss, double blur_rad2) {
    return 1.0 / (1.0 / gloss + blur_rad2);
}

/// The closed form of Reflection::returned(), and of highlight() without blur:
///
/// - diffuse: Oren and Nayar 1994 for light and eye at one place, cos t (A + B sin t tan t) with
///   A = 1 - s²/2 / (s² + 0.33) and B = 0.45 s² / (s² + 0.09), s the roughness; Lambert's cosine
///   where s is 0;
/// - specular: Phong's lobe, normalised so that it sends back no more light than it gets (Lewis
///   1994): (n + 2) / 2 * max(0, cos 2t)^n cos t, since the mirrored ray leaves at 2t from the eye;
/// - retro: the light that comes back is spread over the cone of retro_cone_rad and not over the
///   half space: pi over the cone's solid angle, times cos t.
[[nodiscard]] double returned_share(const Surface& surface, double cos_incidence);

}  // namespace scipd::sim
