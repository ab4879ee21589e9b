// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The triangles of a scene as the depth backend draws them. All are in one frame, W relative to the
// scene's anchor, and are numbered in one list: the number that a pixel holds tells which triangle
// it shows. A model that moves is placed anew in that frame, so drawing and sampling use the same
// list. Knows no OpenGL.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "sim/backends/depth_projection.h"
#include "sim/backends/fan.h"
#include "sim/world/scene.h"

namespace scipd::sim {

using TriangleId = std::uint32_t;

/// A corner. Triangles share corners, but no two have the same first corner: `triangle` is the one
/// whose first corner this is.
struct DrawnVertex {
    glm::vec3 position_m;
    TriangleId triangle;
};

/// In the layout of an index buffer of OpenGL.
struct DrawnTriangle {
    glm::uvec3 corners;  ///< indices of vertices
};

/// What a hit on a triangle needs beside the range.
struct Face {
    glm::vec3 normal{0.0F};  ///< of unit length; outward, where there is an outside
    ObjectId object = 0;
};

struct VertexRange {
    std::size_t first = 0;
    std::size_t count = 0;
};

/// A box along the axes of anchored W.
struct CentredBox {
    glm::vec3 middle_m;
    glm::vec3 half_m;
};

/// Some triangles that lie together. They share no corner with triangles of other blocks.
struct Block {
    CentredBox bounds;
    TriangleId first;
    std::uint32_t count;
    std::uint32_t first_vertex;
    std::uint32_t vertex_count;
};

/// Some blocks that lie together.
struct Cluster {
    CentredBox bounds;
    std::size_t first;
    std::size_t count;
};

/// The triangles of one object.
struct Body {
    ModelId model;
    Block all;
    std::vector<Block> blocks;      ///< one, where they are few
    std::vector<Cluster> clusters;  ///< of blocks
    bool solid;  ///< convex and closed: seen from outside, its front hides its back

    [[nodiscard]] std::span<const Block> of(const Cluster& cluster) const {
        return std::span{blocks}.subspan(cluster.first, cluster.count);
    }
};

class DepthTriangles {
  public:
    explicit DepthTriangles(const Scene& scene);

    [[nodiscard]] std::span<const DrawnVertex> vertices() const { return vertices_; }
    [[nodiscard]] std::span<const DrawnTriangle> triangles() const { return triangles_; }
    [[nodiscard]] std::span<const Face> faces() const { return faces_; }

    /// The body that this triangle belongs to.
    [[nodiscard]] const Body& body_of(TriangleId triangle) const;

    /// Places a movable model elsewhere. Returns which vertices have changed.
    VertexRange move(ModelId model, const Pose& anchored_from_model);

    /// Adds the triangles that can be seen in the frustum, and a few that cannot, but none that are
    /// unseen. Objects are ordered by their distance from the eye, since drawing costs
    /// least where something nearer has been drawn before.
    void collect(const Frustum& frustum, const Unseen& unseen, std::vector<DrawnTriangle>& drawn);

  private:
    /// What is needed to place a body of a movable model anew.
    struct Movable {
        ModelId model;
        Pose model_from_object;
        std::vector<glm::vec3> in_object_m;
        std::uint32_t first_vertex;
        std::size_t body;
    };

    void add(ObjectId id, const Object& object, bool movable, const Pose& anchored_from_object);
    [[nodiscard]] Block block_from(TriangleId first, std::uint32_t first_vertex) const;
    [[nodiscard]] CentredBox bounds_of(const Block& block) const;
    void turn_faces(const Block& block);
    void collect(const Body& body, Frustum::Place place, const Frustum& frustum,
                 std::vector<DrawnTriangle>& drawn);
    void collect(const Block& block, Frustum::Place place, bool hides_back, const Frustum& frustum,
                 std::vector<DrawnTriangle>& drawn);

    std::vector<DrawnVertex> vertices_;
    std::vector<DrawnTriangle> triangles_;
    std::vector<Face> faces_;  ///< by TriangleId, as triangles_
    std::vector<Body> bodies_;
    // A copy of the bodies' boxes, side by side, which alone rule most bodies out. The fourth
    // number is not used: with vectors of three, compilers do not vectorise the loop.
    std::vector<glm::vec4> middles_m_;
    std::vector<glm::vec4> halves_m_;
    std::vector<Movable> movables_;  ///< in the order of their models

    // Kept only for their memory.
    struct Seen {
        float distance;
        Frustum::Place place;
        const Body* body;
    };
    std::vector<Seen> seen_;
    std::vector<std::uint32_t> missed_;  ///< sides of the frustum, by corner
};

}  // namespace scipd::sim
