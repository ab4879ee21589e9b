// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Turns occupancy grids, elevation maps and walls of MVSim into meshes and boxes. Pure. Throws
// std::invalid_argument, saying what cannot be read.
#pragma once

#include <string_view>
#include <vector>

#include "sim/loaders/mvsim/mvsim_node.h"
#include "sim/world/mesh.h"
#include "sim/world/shape.h"

namespace scipd::sim {

struct PlacedMesh {
    Mesh mesh;
    glm::dvec3 origin_m;
};

/// `<element class="occupancy_grid">` of a picture: pixels below half of full brightness become
/// walls between these heights. Without triangles if there is none.
PlacedMesh grid_mesh(const MvsimNode& grid, std::string_view picture, double bottom_m,
                     double top_m);

/// `<element class="elevation_map">`: x grows with the rows of the picture, y with its columns, and
/// its darkest and brightest pixels are the lowest and the highest.
PlacedMesh elevation_mesh(const MvsimNode& map, std::string_view picture);

/// The ground of an `<elevation_data_matrix>`, which has the heights themselves in metres.
PlacedMesh matrix_mesh(const MvsimNode& map, std::string_view matrix);

struct PlacedBox {
    Box box;
    Pose world_from_box;
};

/// `<element class="vertical_plane">`: the wall without its doors and windows.
std::vector<PlacedBox> plane_boxes(const MvsimNode& plane);

/// `<walls>`: one wall between each pair of points. If an earlier wall begins or ends near one of
/// its ends, the wall is longer there by half its thickness, so that corners are closed.
std::vector<PlacedBox> wall_boxes(const MvsimNode& walls);

}  // namespace scipd::sim
