// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Samples a picture for beams: it finds what a beam meets from the pixels around it. A pixel shows
// which triangle is in front at its centre, while the beam may pass beside the centre. A range
// never lies between two objects. Pure; in double precision.
#pragma once

#include <cstddef>
#include <span>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "sim/backends/depth_options.h"
#include "sim/backends/depth_plan.h"
#include "sim/backends/depth_triangles.h"
#include "sim/backends/fan.h"
#include "sim/backends/picture.h"

namespace scipd::sim {

/// For one picture, drawn from one pose of the sensor. All arguments but the pose must outlive it.
class DepthSampler {
  public:
    DepthSampler(const Scene& scene, const DepthTriangles& triangles, const Picture& picture,
                 BetweenPixels between, const Pose& anchored_from_sensor);

    /// Fills the hits of the rays that these looks belong to.
    void sample(std::span<const Look> looks, const Fan& fan, std::span<Hit> hits);

  private:
    struct Around;
    struct Beam;

    [[nodiscard]] Hit hit(const Look& look, const glm::dvec3& direction);

    void look_at(TriangleId triangle);
    [[nodiscard]] Hit at_range(double range_m, const glm::dvec3& direction) const;
    [[nodiscard]] Hit by_depth(std::size_t pixel, const Look& look, const glm::dvec3& direction);
    [[nodiscard]] Hit by_triangles(const Around& around, const Look& look,
                                   const glm::dvec3& direction);
    /// Replaces `first` by something nearer that no pixel shows, if there is such a thing.
    void find_unseen(const Around& around, const Look& look, const Beam& beam, Hit& first);
    [[nodiscard]] bool passes(const Beam& beam, const CentredBox& bounds, double range_m) const;
    [[nodiscard]] bool passes(const Beam& beam, TriangleId triangle) const;
    /// Replaces `first` where the beam meets the triangle, or one of the body, before that.
    void take_nearer(const Beam& beam, TriangleId triangle, Hit& first);
    void take_nearer(const Beam& beam, const Body& body, Hit& first);
    [[nodiscard]] bool agrees(double range_m, std::size_t pixel, const Look& look) const;
    [[nodiscard]] bool meets(const Beam& beam, TriangleId triangle) const;
    [[nodiscard]] double depth_between(const Around& around, const Look& look) const;

    const Scene& scene_;
    const DepthTriangles& triangles_;
    const Picture& picture_;
    BetweenPixels between_;
    glm::dmat3 anchored_from_sensor_;
    glm::dvec3 eye_m_;

    // The triangle of the beam before; neighbouring beams mostly meet the same one.
    TriangleId triangle_ = Picture::nothing;
    glm::dvec3 normal_{0.0};   ///< in S
    double distance_m_ = 0.0;  ///< of the eye from its plane, with the sign of the normal
    MaterialId material_ = 0;
    ObjectId object_ = no_object;
};

}  // namespace scipd::sim
