// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/map/ros_map.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "sim/loaders/file/any_case.h"
#include "sim/loaders/file/load_error.h"
#include "sim/loaders/file/plain_file.h"
#include "sim/loaders/map/map_file.h"
#include "sim/loaders/map/map_picture.h"
#include "sim/loaders/map/map_walls.h"
#include "sim/loaders/map/occupancy.h"
#include "sim/world/anchor.h"
#include "sim/world/reach.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t largest_yaml = 1U << 20U;
constexpr std::uintmax_t largest_picture = 512U << 20U;

CellGrid load_cells(const MapFile& map) {
    const std::string bytes =
        read_file(map.image, largest_picture, "the map's picture is wanted here");
    try {
        return cells_of(read_map_image(bytes), map);
    } catch (const std::invalid_argument& wrong) {
        throw LoadError({map.image.string() + ": " + wrong.what()});
    }
}

/// A large picture with large pixels can reach too far.
void check_extent(const MapFile& map, const CellGrid& grid) {
    const double side_m = map.resolution_m * static_cast<double>(std::max(grid.columns, grid.rows));
    if (side_m <= position_limit_m) return;
    throw LoadError(
        {map.image.string() + ": is more than 1e7 m long at the resolution that the map says"});
}

/// The scene of one map, object by object.
class MapScene {
  public:
    MapScene(const fs::path& file, const MapFile& map, const CellGrid& grid)
        : map_(map), grid_(grid) {
        scene_.name = file.stem().string();
        const Pose world_from_map = pose_from_rpy({map.origin_m, 0.0}, {0.0, 0.0, map.yaw_rad});
        scene_.models.push_back({scene_.name, false, world_from_map});
    }

    void add(Cell which, const std::string& name, const std::string& material,
             const MapOptions& options) {
        auto mesh = std::make_shared<const Mesh>(
            wall_mesh(grid_, which, {map_.resolution_m, options.bottom_m, options.top_m}));
        if (mesh->triangles.empty()) return;
        const glm::dvec2 middle_m = 0.5 * map_.resolution_m * glm::dvec2{grid_.columns, grid_.rows};
        scene_.objects.push_back({scene_.name + "::" + name, 0,
                                  pose_from_rpy({middle_m, 0.0}, glm::dvec3{0.0}), std::move(mesh),
                                  material_id(material)});
    }

    [[nodiscard]] bool empty() const { return scene_.objects.empty(); }

    SharedScene finish() && {
        scene_.anchor_m = anchor_of(scene_);
        return std::make_shared<const Scene>(std::move(scene_));
    }

  private:
    MaterialId material_id(const std::string& name) {
        auto& all = scene_.materials;
        auto found = std::ranges::find(all, name, &Material::name);
        if (found == all.end()) found = all.insert(found, {name});
        return static_cast<MaterialId>(found - all.begin());
    }

    const MapFile& map_;
    const CellGrid& grid_;
    Scene scene_;
};

}  // namespace

LoadedScene load_ros_map(const fs::path& given, const MapOptions& options) {
    assert(options.bottom_m < options.top_m);
    const auto file = fs::absolute(given).lexically_normal();
    MapFile map = parse_map_file(read_file(file, largest_yaml, "name the YAML of a ROS map"), file);
    map.image = as_it_is_called(map.image, map.warnings);
    CellGrid grid = load_cells(map);
    check_extent(map, grid);
    if (options.unknown == UnknownCells::wall) {
        std::ranges::replace(grid.cells, Cell::unknown, Cell::occupied);
    }
    MapScene scene{file, map, grid};
    try {
        scene.add(Cell::occupied, "walls", options.material, options);
        if (options.unknown == UnknownCells::unknown) {
            scene.add(Cell::unknown, "unknown", "unknown", options);
        }
    } catch (const std::invalid_argument& wrong) {
        throw LoadError({map.image.string() + ": " + wrong.what()});
    }
    if (scene.empty()) {
        map.warnings.push_back(map.image.string() +
                               ": holds no wall that a scanner could see: no cell is above the "
                               "occupied_thresh of " +
                               file.string());
    }
    return {std::move(scene).finish(), map.warnings};
}

}  // namespace scipd::sim
