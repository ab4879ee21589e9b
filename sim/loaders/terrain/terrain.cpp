// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Heights lie where gz-rendering 7 (OgreHeightmap.cc) and gz-common 5 (ImageHeightmap.hh, Dem.cc)
// put them. Gazebo Classic 11 agrees (physics/HeightmapShape.cc, rendering/Heightmap.cc).
#include "sim/loaders/terrain/terrain.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <glm/common.hpp>

#include "sim/loaders/file/load_error.h"
#include "sim/loaders/terrain/height_file.h"
#include "sim/world/reach.h"

namespace scipd::sim {
namespace {

bool is_power_of_two_and_one(std::size_t side) {
    return side > 1 && ((side - 1) & (side - 2)) == 0;
}

std::string extent_of(const HeightGrid& grid) {
    return std::to_string(grid.width) + " x " + std::to_string(grid.height) + " points";
}

/// A grid of heights, with `sampling` steps from each of its points to the next.
class Surface {
  public:
    Surface(const HeightGrid& grid, const glm::dvec3& size_m, std::size_t sampling)
        : grid_(grid),
          size_m_(size_m),
          sampling_(sampling),
          columns_((grid.width - 1) * sampling + 1),
          rows_((grid.height - 1) * sampling + 1) {
        const double spread = grid.high - grid.low;
        scale_ = std::abs(size_m.z) / (spread > 0.0 ? spread : 1.0);
    }

    /// The height of the lowest value of the grid.
    [[nodiscard]] double base_m() const { return height_m(grid_.low); }

    /// Heights are relative to base_m(), since floats are finest around zero.
    [[nodiscard]] Mesh mesh() const {
        Mesh mesh;
        mesh.vertices_m.reserve(columns_ * rows_);
        mesh.triangles.reserve(2 * (columns_ - 1) * (rows_ - 1));
        for (std::size_t row = 0; row < rows_; ++row) {
            for (std::size_t column = 0; column < columns_; ++column) {
                mesh.vertices_m.push_back(vertex_m(row, column));
                if (row > 0 && column > 0) add_square(mesh.vertices_m.size() - 1, mesh);
            }
        }
        return mesh;
    }

  private:
    [[nodiscard]] double height_m(double value) const {
        const double up_m = grid_.low + (value - grid_.low) * scale_;
        return size_m_.z < 0.0 ? grid_.top_upside_down_m - up_m : up_m;
    }

    [[nodiscard]] double value_at(std::size_t row, std::size_t column) const {
        return grid_.values[row * grid_.width + column];
    }

    [[nodiscard]] glm::vec3 vertex_m(std::size_t row, std::size_t column) const {
        const std::size_t north = row / sampling_;
        const std::size_t south = std::min(north + 1, grid_.height - 1);
        const std::size_t west = column / sampling_;
        const std::size_t east = std::min(west + 1, grid_.width - 1);
        const double down = static_cast<double>(row % sampling_) / static_cast<double>(sampling_);
        const double right =
            static_cast<double>(column % sampling_) / static_cast<double>(sampling_);
        const double value =
            glm::mix(glm::mix(value_at(north, west), value_at(north, east), right),
                     glm::mix(value_at(south, west), value_at(south, east), right), down);
        const double x = static_cast<double>(column) / static_cast<double>(columns_ - 1) - 0.5;
        const double y = 0.5 - static_cast<double>(row) / static_cast<double>(rows_ - 1);
        return {x * size_m_.x, y * size_m_.y, height_m(value) - base_m()};
    }

    /// The square to the north-west of this vertex, which is the last one so far.
    void add_square(std::size_t vertex, Mesh& mesh) const {
        const auto south_east = static_cast<glm::uint>(vertex);
        const auto south_west = south_east - 1;
        const auto north_east = south_east - static_cast<glm::uint>(columns_);
        const auto north_west = north_east - 1;
        mesh.triangles.emplace_back(south_west, south_east, north_east);
        mesh.triangles.emplace_back(south_west, north_east, north_west);
    }

    const HeightGrid& grid_;
    glm::dvec3 size_m_;
    std::size_t sampling_;
    std::size_t columns_;
    std::size_t rows_;
    double scale_;
};

/// The sampling to use: 1 if `wanted` would make too many triangles. Throws LoadError if 1 does
/// too.
std::size_t sampling_for(const HeightGrid& grid, std::size_t wanted, std::size_t most_triangles,
                         std::vector<std::string>& remarks) {
    if (grid.width < 2 || grid.height < 2) {
        throw LoadError({"has " + extent_of(grid) + "; a terrain needs two by two at least"});
    }
    const std::size_t triangles = 2 * (grid.width - 1) * (grid.height - 1);
    if (triangles > most_triangles) {
        throw LoadError({"has " + extent_of(grid) + ", which make " + std::to_string(triangles) +
                         " triangles; at most " + std::to_string(most_triangles) +
                         " are read; scale it down"});
    }
    const std::size_t most_sampling = most_triangles / triangles;
    if (wanted <= most_sampling && wanted * wanted <= most_sampling) {
        return std::max<std::size_t>(wanted, 1);
    }
    remarks.push_back("a <sampling> of " + std::to_string(wanted) + " would make more than " +
                      std::to_string(most_triangles) + " triangles; 1 is taken");
    return 1;
}

glm::dvec3 size_of(const TerrainView& view, const HeightGrid& grid) {
    const glm::dvec3 size_m = view.size_m.value_or(grid.size_m);
    const bool is_plausible = size_m.x > 0.0 && size_m.y > 0.0 && plausible_position(size_m);
    if (!is_plausible) {
        throw LoadError(
            {"the <size> of a <heightmap> must be above 0 in x and y and at most 1e7 m; an "
             "elevation model that does not say where on Earth it lies needs a <size>"});
    }
    return size_m;
}

Terrain terrain(const HeightGrid& grid, const TerrainView& view, std::size_t most_triangles) {
    std::vector<std::string> remarks = grid.remarks;
    const glm::dvec3 size_m = size_of(view, grid);
    const auto sampling = sampling_for(grid, view.sampling, most_triangles, remarks);
    if (grid.width != grid.height || !is_power_of_two_and_one(grid.width)) {
        remarks.push_back("has " + extent_of(grid) +
                          "; Gazebo shows squares of 2^n + 1 only, scipd stretches it over its "
                          "<size>");
    }
    const Surface surface{grid, size_m, sampling};
    const glm::dvec3 at_m = view.position_m + glm::dvec3{0.0, 0.0, surface.base_m()};
    return {std::make_shared<const Mesh>(surface.mesh()), at_m, std::move(remarks)};
}

}  // namespace

Terrain terrain_of(const std::filesystem::path& file, const TerrainView& view,
                   std::size_t most_triangles) {
    const HeightGrid grid = read_heights(file);
    try {
        Terrain made = terrain(grid, view, most_triangles);
        for (auto& remark : made.remarks)
            remark.insert(0, file.string() + ": ");
        return made;
    } catch (const LoadError& error) {
        throw LoadError({file.string() + ": " + error.what()});
    }
}

}  // namespace scipd::sim
