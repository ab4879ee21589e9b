// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Draws triangles into pictures of depth and triangle numbers, without light, blending or
// antialiasing, and reads them back. The only user of OpenGL beside the context. Binds the
// context to the thread that calls.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "sim/backends/depth_plan.h"
#include "sim/backends/depth_triangles.h"
#include "sim/backends/egl_context.h"
#include "sim/backends/picture.h"

namespace scipd::sim {

/// One rectangle of the picture and what is drawn into it. The projection is of a rectangle that is
/// wider by a margin, of which nothing is drawn: rasterisers clip triangles at its border, which
/// costs more than leaving out their pixels.
struct DrawnView {
    glm::ivec2 corner_px{0, 0};
    glm::ivec2 size_px{0, 0};
    glm::ivec2 margin_px{0, 0};
    glm::vec3 eye_m{0.0F};           ///< in anchored W
    glm::mat4 clip_from_eye{1.0F};   ///< of points relative to the eye, along the axes of W
    std::size_t first_triangle = 0;  ///< in what is handed over with the views
    std::size_t triangle_count = 0;
};

/// With the triangles that lie at these places of the list. The eye is the pose's.
DrawnView drawn_view(const PlannedView& view, const Pose& anchored_from_sensor,
                     std::size_t first_triangle, std::size_t triangle_count);

class DepthRaster {
  public:
    explicit DepthRaster(std::shared_ptr<EglContext> context);
    DepthRaster(const DepthRaster&) = delete;
    DepthRaster& operator=(const DepthRaster&) = delete;
    ~DepthRaster();

    [[nodiscard]] EglContext& context() { return *context_; }

    /// What triangles refer to from now on.
    void set_vertices(std::span<const DrawnVertex> vertices);

    /// Puts as many vertices at other places, from this one on.
    void replace_vertices(std::size_t first, std::span<const DrawnVertex> vertices);

    /// Draws all views, each with its triangles, into a picture of this size. Views lie inside of
    /// it and do not overlap.
    void draw(std::span<const DrawnView> views, std::span<const DrawnTriangle> triangles,
              glm::ivec2 size_px);

    /// Returns when all is drawn.
    void finish();

    /// Back from where it was drawn, all at once or one after the other.
    void read(Picture& picture);
    void read_depth(Picture& picture);
    void read_triangles(Picture& picture);

  private:
    void make_picture(glm::ivec2 size_px);
    std::size_t begin_reading(Picture& picture);

    std::shared_ptr<EglContext> context_;
    glm::ivec2 drawable_px_{0, 0};
    glm::ivec2 drawn_px_{0, 0};
    // Names of OpenGL's.
    unsigned program_ = 0;  ///< the context's
    unsigned vertex_array_ = 0;
    unsigned vertices_ = 0;
    unsigned indices_ = 0;
    unsigned frame_ = 0;
    unsigned depth_ = 0;
    unsigned triangle_ = 0;
};

}  // namespace scipd::sim
