// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/world/extrusion.h"

#include <algorithm>
#include <cstddef>

namespace scipd::sim {
namespace {

/// From its lower end to its upper one.
struct Edge {
    glm::dvec2 low;
    glm::dvec2 high;

    [[nodiscard]] double x_at(double y) const {
        return low.x + (high.x - low.x) * (y - low.y) / (high.y - low.y);
    }
};

/// Those that are not level.
std::vector<Edge> edges_of(const std::vector<Outline>& outlines) {
    std::vector<Edge> edges;
    for (const Outline& outline : outlines) {
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const glm::dvec2& a = outline[i];
            const glm::dvec2& b = outline[(i + 1) % outline.size()];
            if (a.y < b.y) edges.push_back({a, b});
            if (b.y < a.y) edges.push_back({b, a});
        }
    }
    return edges;
}

std::vector<double> levels_of(const std::vector<Outline>& outlines) {
    std::vector<double> levels;
    for (const Outline& outline : outlines) {
        for (const glm::dvec2& point : outline)
            levels.push_back(point.y);
    }
    std::ranges::sort(levels);
    levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
    return levels;
}

/// A floor and a top of the same four corners.
void add_trapezoid(const Edge& left, const Edge& right, double low_y, double high_y,
                   double height_m, Mesh& mesh) {
    for (const double z : {0.0, height_m}) {
        const auto first = static_cast<glm::uint>(mesh.vertices_m.size());
        mesh.vertices_m.insert(mesh.vertices_m.end(), {{left.x_at(low_y), low_y, z},
                                                       {right.x_at(low_y), low_y, z},
                                                       {right.x_at(high_y), high_y, z},
                                                       {left.x_at(high_y), high_y, z}});
        mesh.triangles.emplace_back(first, first + 1, first + 2);
        mesh.triangles.emplace_back(first, first + 2, first + 3);
    }
}

/// The area is cut level at every corner. Between two cuts no edge ends, so that from left to right
/// they take turns to lead in and out.
void add_floor_and_top(const std::vector<Outline>& outlines, double height_m, Mesh& mesh) {
    const std::vector<Edge> edges = edges_of(outlines);
    const std::vector<double> levels = levels_of(outlines);
    for (std::size_t i = 1; i < levels.size(); ++i) {
        const double low_y = levels[i - 1];
        const double high_y = levels[i];
        std::vector<Edge> crossing;
        std::ranges::copy_if(edges, std::back_inserter(crossing), [&](const Edge& edge) {
            return edge.low.y <= low_y && edge.high.y >= high_y;
        });
        std::ranges::sort(crossing, {}, [middle = 0.5 * (low_y + high_y)](const Edge& edge) {
            return edge.x_at(middle);
        });
        for (std::size_t k = 1; k < crossing.size(); k += 2)
            add_trapezoid(crossing[k - 1], crossing[k], low_y, high_y, height_m, mesh);
    }
}

void add_walls(const Outline& outline, double height_m, Mesh& mesh) {
    const auto first = static_cast<glm::uint>(mesh.vertices_m.size());
    const auto count = static_cast<glm::uint>(outline.size());
    for (const glm::dvec2& point : outline) {
        mesh.vertices_m.emplace_back(point.x, point.y, 0.0);
        mesh.vertices_m.emplace_back(point.x, point.y, height_m);
    }
    for (glm::uint i = 0; i < count; ++i) {
        const glm::uint here = first + 2 * i;
        const glm::uint next = first + 2 * ((i + 1) % count);
        mesh.triangles.emplace_back(here, next, next + 1);
        mesh.triangles.emplace_back(here, next + 1, here + 1);
    }
}

}  // namespace

Mesh extrusion_mesh(const std::vector<Outline>& outlines, double height_m) {
    Mesh mesh;
    for (const Outline& outline : outlines)
        add_walls(outline, height_m, mesh);
    add_floor_and_top(outlines, height_m, mesh);
    return mesh;
}

}  // namespace scipd::sim
