// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/depth_sampler.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace scipd::sim {

/// The pixels around a beam: one, two or four different ones.
struct DepthSampler::Around {
    Around(const Look& look, const Picture& picture) {
        const std::size_t left = look.share.x > 0.0F ? 1 : 0;
        const std::size_t above =
            look.share.y > 0.0F ? static_cast<std::size_t>(picture.size_px.x) : 0;
        pixels = {look.pixel, look.pixel + left, look.pixel + above, look.pixel + left + above};
        nearest = pixels[(look.share.x > 0.5F ? 1 : 0) + (look.share.y > 0.5F ? 2 : 0)];
        note_shown(picture);
    }
    /// A pixel, and those on both sides of it.
    Around(std::size_t pixel, const Picture& picture)
        : pixels{pixel, std::max<std::size_t>(pixel, 1) - 1,
                 std::min(pixel + 1, picture.triangle.size() - 1), pixel},
          nearest(pixel) {
        note_shown(picture);
    }
    /// The four pixels beside one.
    static Around beside(std::size_t pixel, const Picture& picture) {
        Around around(pixel, picture);
        const auto row = static_cast<std::size_t>(picture.size_px.x);
        around.pixels[0] = pixel < row ? pixel : pixel - row;
        around.pixels[3] = pixel + row < picture.triangle.size() ? pixel + row : pixel;
        around.note_shown(picture);
        return around;
    }

    void note_shown(const Picture& picture) {
        for (std::size_t i = 0; i < pixels.size(); ++i)
            shown[i] = picture.triangle[pixels[i]];
        any_nothing = picture.triangle[nearest] == Picture::nothing ||
                      std::ranges::find(shown, Picture::nothing) != shown.end();
    }
    [[nodiscard]] bool one_triangle() const {
        return shown[0] == shown[1] && shown[0] == shown[2] && shown[0] == shown[3];
    }
    [[nodiscard]] bool nothing_shown() const {
        return one_triangle() && shown[0] == Picture::nothing;
    }

    std::array<std::size_t, 4> pixels;
    std::size_t nearest;
    std::array<TriangleId, 4> shown;
    bool any_nothing = false;  ///< one of them, or the nearest pixel, shows nothing
};

/// A beam, and the normals of two planes through it, in anchored W.
struct DepthSampler::Beam {
    Beam(const glm::dvec3& in_sensor, const glm::dmat3& anchored_from_sensor)
        : direction(in_sensor),
          along(anchored_from_sensor * in_sensor),
          side(anchored_from_sensor * glm::dvec3{-in_sensor.y, in_sensor.x, 0.0}),
          above(glm::cross(along, side)) {}

    glm::dvec3 direction;  ///< in S
    glm::dvec3 along;
    glm::dvec3 side;
    glm::dvec3 above;
};

DepthSampler::DepthSampler(const Scene& scene, const DepthTriangles& triangles,
                           const Picture& picture, BetweenPixels between,
                           const Pose& anchored_from_sensor)
    : scene_(scene),
      triangles_(triangles),
      picture_(picture),
      between_(between),
      anchored_from_sensor_(glm::mat3_cast(anchored_from_sensor.rotation)),
      eye_m_(anchored_from_sensor.translation_m) {}

void DepthSampler::sample(std::span<const Look> looks, const Fan& fan, std::span<Hit> hits) {
    for (const Look& look : looks) {
        const Hit met = hit(look, glm::dvec3{fan.directions[look.ray]});
        hits[look.ray] = met.range_m <= fan.max_range_m ? met : Hit{};
    }
}

Hit DepthSampler::hit(const Look& look, const glm::dvec3& direction) {
    const Around around(look, picture_);
    if (between_ == BetweenPixels::nearest) return by_depth(around.nearest, look, direction);
    if (!around.one_triangle()) return by_triangles(around, look, direction);
    // Graphics devices leave a pixel out here and there where two triangles meet.
    if (around.shown[0] == Picture::nothing) {
        const Around beside = Around::beside(around.nearest, picture_);
        return beside.nothing_shown() ? Hit{} : by_triangles(beside, look, direction);
    }
    look_at(around.shown[0]);
    if (between_ == BetweenPixels::interpolate) {
        const double z_m = z_of_depth_m(depth_between(around, look));
        return at_range(z_m / double{look.cos_alpha}, direction);
    }
    const double range_m = distance_m_ / glm::dot(normal_, direction);
    if (agrees(range_m, look.pixel, look)) return at_range(range_m, direction);
    // The triangle is seen so flat that a driver draws it where it is not. Perhaps the beam meets
    // what the pixels beside this one show.
    return by_triangles(Around(around.nearest, picture_), look, direction);
}

void DepthSampler::look_at(TriangleId triangle) {
    if (triangle == triangle_) return;
    triangle_ = triangle;
    const Face& face = triangles_.faces()[triangle];
    const std::uint32_t corner = triangles_.triangles()[triangle].corners.x;
    const glm::dvec3 normal{face.normal};
    normal_ = normal * anchored_from_sensor_;  // from the left: by the transpose
    distance_m_ = glm::dot(normal, glm::dvec3{triangles_.vertices()[corner].position_m} - eye_m_);
    object_ = face.object;
    material_ = scene_.objects[object_].material;
}

Hit DepthSampler::at_range(double range_m, const glm::dvec3& direction) const {
    const double cosine = std::min(1.0, std::abs(glm::dot(normal_, direction)));
    return {static_cast<float>(range_m), static_cast<float>(cosine), material_, object_};
}

/// Equations (1) and (2) of the depth-buffer method (depth_projection.h).
Hit DepthSampler::by_depth(std::size_t pixel, const Look& look, const glm::dvec3& direction) {
    if (picture_.triangle[pixel] == Picture::nothing) return {};
    look_at(picture_.triangle[pixel]);
    const double z_m = z_of_depth_m(double{picture_.depth[pixel]});
    return at_range(z_m / double{look.cos_alpha}, direction);
}

/// Whether a range that follows from a triangle's plane is near the depth of the pixel that shows
/// it. Where it is not, the triangle is seen so flat that it may be met elsewhere or not at all.
bool DepthSampler::agrees(double range_m, std::size_t pixel, const Look& look) const {
    constexpr double share = 0.02;
    const double near_plane_m = range_m * double{look.cos_alpha} * double{picture_.depth[pixel]};
    return std::abs(near_plane_m - near_m) <= share * near_m;
}

/// Depth is n/z, and 1/z is linear in the picture.
double DepthSampler::depth_between(const Around& around, const Look& look) const {
    const auto mix = [](double a, double b, double share) { return a + share * (b - a); };
    const auto depth = [&](std::size_t i) { return double{picture_.depth[around.pixels[i]]}; };
    return mix(mix(depth(0), depth(1), double{look.share.x}),
               mix(depth(2), depth(3), double{look.share.x}), double{look.share.y});
}

/// Looks at which side of each edge the beam passes. Two triangles that share an edge compute the
/// same number for it, so no beam slips between them.
bool DepthSampler::meets(const Beam& beam, TriangleId triangle) const {
    const glm::uvec3 corners = triangles_.triangles()[triangle].corners;
    const auto vertices = triangles_.vertices();
    const glm::dvec3 a = glm::dvec3{vertices[corners.x].position_m} - eye_m_;
    const glm::dvec3 b = glm::dvec3{vertices[corners.y].position_m} - eye_m_;
    const glm::dvec3 c = glm::dvec3{vertices[corners.z].position_m} - eye_m_;
    const double ab = glm::dot(beam.along, glm::cross(a, b));
    const double bc = glm::dot(beam.along, glm::cross(b, c));
    const double ca = glm::dot(beam.along, glm::cross(c, a));
    return (ab >= 0.0 && bc >= 0.0 && ca >= 0.0) || (ab <= 0.0 && bc <= 0.0 && ca <= 0.0);
}

/// Whether the whole box lies on one side of the beam, or farther away than `range_m`.
bool DepthSampler::passes(const Beam& beam, const CentredBox& bounds, double range_m) const {
    const glm::dvec3 middle_m = glm::dvec3{bounds.middle_m} - eye_m_;
    const glm::dvec3 half_m{bounds.half_m};
    const auto reach_m = [&](const glm::dvec3& normal) {
        return glm::dot(glm::abs(normal), half_m);
    };
    return std::abs(glm::dot(beam.side, middle_m)) > reach_m(beam.side) ||
           std::abs(glm::dot(beam.above, middle_m)) > reach_m(beam.above) ||
           glm::dot(beam.along, middle_m) - reach_m(beam.along) > range_m;
}

/// Whether the triangle lies on one side of the beam. This alone dismisses most triangles.
bool DepthSampler::passes(const Beam& beam, TriangleId triangle) const {
    constexpr double surely_m = 1e-6;
    const glm::uvec3 corners = triangles_.triangles()[triangle].corners;
    const auto vertices = triangles_.vertices();
    const auto off_m = [&](std::uint32_t corner) {
        return glm::dot(glm::dvec3{vertices[corner].position_m} - eye_m_, beam.side);
    };
    const double a_m = off_m(corners.x);
    const double b_m = off_m(corners.y);
    const double c_m = off_m(corners.z);
    return (a_m > surely_m && b_m > surely_m && c_m > surely_m) ||
           (a_m < -surely_m && b_m < -surely_m && c_m < -surely_m);
}

void DepthSampler::take_nearer(const Beam& beam, TriangleId triangle, Hit& first) {
    if (!meets(beam, triangle)) return;
    look_at(triangle);
    const double range_m = distance_m_ / glm::dot(normal_, beam.direction);
    if (range_m > 0.0 && range_m < double{first.range_m}) first = at_range(range_m, beam.direction);
}

void DepthSampler::take_nearer(const Beam& beam, const Body& body, Hit& first) {
    for (const Cluster& cluster : body.clusters) {
        if (passes(beam, cluster.bounds, double{first.range_m})) continue;
        for (const Block& block : body.of(cluster)) {
            if (passes(beam, block.bounds, double{first.range_m})) continue;
            const TriangleId end = block.first + block.count;
            for (TriangleId triangle = block.first; triangle < end; ++triangle) {
                if (!passes(beam, triangle)) take_nearer(beam, triangle, first);
            }
        }
    }
}

/// A pixel may show something nearer than what the beam has met so far. Then a triangle beside the
/// shown one may reach up to the beam and be too narrow for a pixel of its own: a facet at the rim
/// of a post, say.
void DepthSampler::find_unseen(const Around& around, const Look& look, const Beam& beam,
                               Hit& first) {
    for (std::size_t i = 0; i < around.shown.size(); ++i) {
        const TriangleId shown = around.shown[i];
        if (shown == Picture::nothing || (i > 0 && shown == around.shown[i - 1])) continue;
        const double shown_m =
            z_of_depth_m(double{picture_.depth[around.pixels[i]]}) / double{look.cos_alpha};
        if (double{first.range_m} < shown_m) continue;
        Hit unseen = first;
        // A beam between a pixel that shows something and one that shows nothing either misses the
        // thing or meets it near the range that is shown, but meets nothing far behind it.
        constexpr double where_seen = 1.02;
        if (!first.met() && around.any_nothing)
            unseen.range_m = static_cast<float>(where_seen * shown_m);
        take_nearer(beam, triangles_.body_of(shown), unseen);
        if (unseen.met()) first = unseen;
    }
}

/// At an edge: takes the nearest of the shown triangles that the beam meets. A beam may miss them
/// all although every pixel around it shows something. Then it meets a triangle that is too small
/// for any pixel to show, and the plane of the nearest pixel's triangle is the best there is.
Hit DepthSampler::by_triangles(const Around& around, const Look& look,
                               const glm::dvec3& direction) {
    const Beam beam(direction, anchored_from_sensor_);
    Hit first;
    for (std::size_t i = 0; i < around.shown.size(); ++i) {
        const TriangleId triangle = around.shown[i];
        const bool again = i > 0 && triangle == around.shown[i - 1];
        if (triangle != Picture::nothing && !again) take_nearer(beam, triangle, first);
    }
    find_unseen(around, look, beam, first);
    if (first.met() || around.any_nothing) return first;
    const std::size_t pixel = around.nearest;
    look_at(picture_.triangle[pixel]);
    const double range_m = distance_m_ / glm::dot(normal_, direction);
    if (agrees(range_m, pixel, look)) return at_range(range_m, direction);
    return by_depth(pixel, look, direction);
}

}  // namespace scipd::sim
