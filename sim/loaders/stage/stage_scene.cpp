// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/stage/stage_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <set>
#include <stdexcept>
#include <utility>

#include <glm/common.hpp>

#include "sim/loaders/file/any_case.h"
#include "sim/loaders/file/load_error.h"
#include "sim/loaders/file/plain_file.h"
#include "sim/loaders/file/scene_draft.h"
#include "sim/loaders/map/map_picture.h"
#include "sim/loaders/map/map_walls.h"
#include "sim/loaders/map/occupancy.h"
#include "sim/loaders/stage/stage_file.h"
#include "sim/text/free_names.h"
#include "sim/text/quote.h"
#include "sim/world/bounds.h"
#include "sim/world/extrusion.h"
#include "sim/world/reach.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t largest_text = 16U << 20U;
constexpr std::uintmax_t largest_stage_picture = 512U << 20U;
constexpr std::size_t most_triangles = 20'000'000;
constexpr double boundary_m = 0.01;

/// Types that have a body only if the file gives them one.
constexpr std::array sensors{"ranger", "laser",        "sensor",    "camera",
                             "sonar",  "blobfinder",   "fiducial",  "fiducialfinder",
                             "bumper", "wifi",         "loadcell",  "lightindicator",
                             "speech", "blinkenlight", "powerpack", "block",
                             "window", "gui",          "audio"};

bool is_sensor(const std::string& type) {
    return std::ranges::find(sensors, type) != sensors.end();
}

bool has_default_body(const std::string& type) {
    return type == "model" || type == "position";
}

bool has_shape(const StageEntity& entity) {
    return entity.find("bitmap") != nullptr || entity.number("noblocks", 0.0) != 0.0 ||
           std::ranges::any_of(entity.children,
                               [](const StageEntity& child) { return child.type == "block"; });
}

/// Stage looks beside the world. If nothing is there, this looks beside the including file, where
/// people expect it.
fs::path path_of(const std::string& name, const fs::path& world, const fs::path& by) {
    const fs::path beside_world = world.parent_path() / name;
    return check_plain_file(beside_world) ? beside_world : by.parent_path() / name;
}

class StageScene {
  public:
    StageScene(fs::path file, StageFile stage)
        : file_(std::move(file)), draft_(file_, false, std::move(stage.warnings)) {
        draft_.set_name(file_.stem().string());
        const std::string length = stage.world.text("unit_length", "m");
        units_.metres = length == "cm" ? 0.01 : (length == "mm" ? 0.001 : 1.0);
        const bool in_radians = stage.world.text("unit_angle", "degrees") == "radians";
        units_.radians = in_radians ? 1.0 : std::numbers::pi / 180.0;
        for (const StageEntity& entity : stage.world.children)
            add_model(entity);
    }

    LoadedScene finish() && { return std::move(draft_).finish("body"); }

  private:
    /// Where an entity stands in its model, and its name there.
    struct Stand {
        ModelId model;
        Pose model_from_entity;
        std::string name;
    };

    void add_model(const StageEntity& entity) {
        if (is_sensor(entity.type)) return;
        // As Stage numbers entities that have no name.
        const std::string said = entity.text("name", entity.type.c_str());
        const std::string name = names_.take(said.empty() ? entity.type : said);
        try {
            const ModelId model =
                draft_.add(Model{name, entity.type == "position", pose_of(entity, "pose")});
            add({model, Pose{}, name}, entity);
        } catch (const std::invalid_argument& wrong) {
            leave_out(entity, name, wrong.what());
        }
    }

    void add(const Stand& stand, const StageEntity& entity) {
        const glm::dvec3 size_m = stage_size_m(entity, units_);
        const bool is_seen =
            entity.number("ranger_return", 1.0) >= 0.0 && entity.number("laser_return", 1.0) != 0.0;
        if (is_seen) add_body(stand, entity, size_m);
        if (!is_seen || has_shape(entity)) tell_of_unknown(entity);
        // Children stand on top.
        const double top_m = entity.number("stack_children", 1.0) != 0.0 ? size_m.z : 0.0;
        for (const StageEntity& child : entity.children) {
            if (child.type != "block") add_child(stand, child, top_m);
        }
    }

    /// Warns of a type that neither Stage nor the file knows; Stage itself would end there.
    /// add_body() leaves the entity out if it has no shape.
    void tell_of_unknown(const StageEntity& entity) {
        const bool is_known = has_default_body(entity.type) || is_sensor(entity.type);
        if (is_known || !unknown_.insert(entity.type).second) return;
        draft_.warn(entity.place + ": " + quote(entity.type) +
                    " is neither defined nor a model of Stage; its properties are used, here "
                    "and elsewhere");
    }

    void add_child(const Stand& parent, const StageEntity& child, double top_m) {
        const std::string name = parent.name + "::" + child.text("name", child.type.c_str());
        try {
            const Pose on_top{{0.0, 0.0, top_m}, {1.0, 0.0, 0.0, 0.0}};
            add({parent.model, parent.model_from_entity * on_top * pose_of(child, "pose"), name},
                child);
        } catch (const std::invalid_argument& wrong) {
            leave_out(child, name, wrong.what());
        }
    }

    void add_body(const Stand& stand, const StageEntity& entity, const glm::dvec3& size_m) {
        const Stand body{stand.model, stand.model_from_entity * pose_of(entity, "origin"),
                         stand.name + "::body"};
        const Pose lifted{{0.0, 0.0, 0.5 * size_m.z}, {1.0, 0.0, 0.0, 0.0}};
        std::vector<Mesh> blocks = block_meshes(entity, size_m, units_);
        const bool has_blocks = !blocks.empty();
        for (Mesh& block : blocks)
            add_mesh(body, std::move(block));
        if (const std::string bitmap = entity.text("bitmap"); !bitmap.empty()) {
            add_bitmap(body, entity, bitmap, size_m);
        } else if (!has_blocks && entity.number("noblocks", 0.0) == 0.0) {
            if (has_default_body(entity.type)) {
                add_object(body, lifted, Box{size_m});
            } else if (!is_sensor(entity.type)) {
                draft_.leave_out(entity.place + ": " + quote(entity.type) +
                                 " is no model that is known");
            }
        }
        if (entity.number("boundary", 0.0) != 0.0) add_boundary(body, size_m, lifted);
    }

    void add_bitmap(const Stand& body, const StageEntity& entity, const std::string& name,
                    const glm::dvec3& size_m) {
        const fs::path place{entity.place.substr(0, entity.place.rfind(':'))};
        std::vector<std::string> warnings;
        const fs::path picture = as_it_is_called(path_of(name, file_, place), warnings);
        for (const auto& warning : warnings)
            draft_.warn(entity.place + ": " + warning);
        try {
            const std::string bytes =
                read_file(picture, largest_stage_picture, "a bitmap is wanted here");
            Mesh dark = bitmap_mesh(bytes, size_m, most_triangles - triangles_);
            if (!dark.triangles.empty()) return add_mesh(body, std::move(dark));
            draft_.warn(entity.place + ": " + picture.string() +
                        " has no dark pixel, and so no wall");
        } catch (const LoadError& wrong) {
            draft_.leave_out(entity.place + ": " + wrong.what());
        } catch (const std::invalid_argument& wrong) {
            draft_.leave_out(entity.place + ": " + picture.string() + ' ' + wrong.what());
        }
    }

    /// Thin walls along the rim of the size.
    void add_boundary(const Stand& body, const glm::dvec3& size_m, const Pose& lifted) {
        for (const int axis : {0, 1}) {
            glm::dvec3 wall_m = size_m;
            wall_m[axis] = std::min(boundary_m, size_m[axis]);
            for (const double side : {-0.5, 0.5}) {
                Pose pose = lifted;
                pose.translation_m[axis] = side * (size_m[axis] - wall_m[axis]);
                add_object(body, pose, Box{wall_m});
            }
        }
    }

    void add_mesh(const Stand& body, Mesh mesh) {
        if (mesh.triangles.size() > most_triangles - triangles_) {
            throw std::invalid_argument("brings the world to more than 20 million triangles");
        }
        triangles_ += mesh.triangles.size();
        add_object(body, Pose{}, std::make_shared<const Mesh>(std::move(mesh)));
    }

    void add_object(const Stand& body, const Pose& body_from_object, Shape shape) {
        const Pose pose = body.model_from_entity * body_from_object;
        if (!plausible_position(pose.translation_m)) {
            throw std::invalid_argument("lies farther than 1e7 m from the origin");
        }
        draft_.add({body.name, body.model, pose, std::move(shape), 0}, {"wall"});
    }

    /// Four numbers, x y z and heading; Stage 2 had no z.
    Pose pose_of(const StageEntity& entity, const char* property) {
        const auto said = entity.numbers(property);
        if (said.empty()) return {};
        std::array<double, 4> numbers{};
        std::copy_n(said.begin(), std::min<std::size_t>(said.size(), 4), numbers.begin());
        if (said.size() == 3) {
            std::swap(numbers[2], numbers[3]);
            if (!std::exchange(told_of_stage_2_, true)) {
                draft_.warn(entity.place + ": " + property +
                            " has three numbers: x, y and heading are taken, as Stage 2 has them");
            }
        }
        const glm::dvec3 xyz_m = glm::dvec3{numbers[0], numbers[1], numbers[2]} * units_.metres;
        if (!plausible_position(xyz_m) || std::abs(numbers[3]) > 1e6)
            throw std::invalid_argument(std::string(property) + " must lie within 1e7 m");
        return pose_from_rpy(xyz_m, {0.0, 0.0, numbers[3] * units_.radians});
    }

    void leave_out(const StageEntity& entity, const std::string& name, const std::string& why) {
        draft_.leave_out(entity.place + ": " + printable(name) + ": " + why);
    }

    fs::path file_;
    StageUnits units_;
    SceneDraft draft_;
    FreeNames names_{':', 1};
    std::set<std::string> unknown_;  ///< types that a warning has named
    std::size_t triangles_ = 0;
    bool told_of_stage_2_ = false;
};

/// Scales the meshes, as Stage does, so that all of them together span the size. In x and y their
/// middle moves to the origin; z is only scaled.
void fit(std::vector<Mesh>& meshes, const glm::dvec3& size_m) {
    Bounds bounds;
    for (const Mesh& mesh : meshes) {
        for (const glm::vec3& vertex : mesh.vertices_m)
            bounds.include(vertex);
    }
    const glm::dvec3 span = bounds.high_m - bounds.low_m;
    if (!(span.x > 1e-9 && span.y > 1e-9 && span.z > 1e-9)) {
        throw std::invalid_argument("has a body without volume");
    }
    glm::dvec3 middle = bounds.middle_m();
    middle.z = 0.0;
    for (Mesh& mesh : meshes) {
        for (glm::vec3& vertex : mesh.vertices_m)
            vertex = (glm::dvec3{vertex} - middle) * size_m / span;
    }
    const double highest_m =
        std::max(std::abs(bounds.low_m.z), std::abs(bounds.high_m.z)) * size_m.z;
    if (!(highest_m / span.z <= position_limit_m)) {
        throw std::invalid_argument("has a body higher than 1e7 m");
    }
}

/// Before the block is scaled to the size of the entity.
Mesh prism(const StageEntity& block, const StageUnits& units) {
    constexpr double most_points = 1'000;
    const double count = block.number("points", 0.0);
    if (!(count >= 3 && count <= most_points)) {
        throw std::invalid_argument("a block has from 3 to 1000 points");
    }
    Outline outline;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        const std::string name = "point[" + std::to_string(i) + "]";
        const auto xy = block.numbers(name);
        if (xy.size() < 2) throw std::invalid_argument(name + " must be [x y]");
        outline.emplace_back(xy[0] * units.metres, xy[1] * units.metres);
        if (!plausible_position({outline.back(), 0.0}))
            throw std::invalid_argument(name + " must lie within 1e7 m");
    }
    auto z = block.numbers("z");
    if (z.size() < 2) z = {0.0, 1.0};
    if (!(z[0] < z[1] && plausible_position({z[0], z[1], 0.0})))
        throw std::invalid_argument("z must be [bottom top]");
    Mesh mesh = extrusion_mesh({outline}, (z[1] - z[0]) * units.metres);
    for (glm::vec3& vertex : mesh.vertices_m)
        vertex.z += static_cast<float>(z[0] * units.metres);
    return mesh;
}

/// Dark is what Stage takes for an obstacle: a first channel of up to 127 of 255.
CellGrid dark_cells(const MapImage& image) {
    CellGrid grid{image.width, image.height, {}};
    grid.cells.reserve(grid.columns * grid.rows);
    const unsigned brightest = 127U * image.white / 255U;
    std::visit(
        [&](const auto& samples) {
            for (std::size_t row = grid.rows; row-- > 0;) {
                for (std::size_t column = 0; column < grid.columns; ++column) {
                    const auto first = samples[(row * grid.columns + column) * image.channels];
                    grid.cells.push_back(first > brightest ? Cell::free : Cell::occupied);
                }
            }
        },
        image.samples);
    return grid;
}

}  // namespace

bool is_stage(std::string_view text) {
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
    const auto first = text.find_first_not_of(" \t\r\n");
    return first != text.npos && text[first] != '<';
}

LoadedScene load_stage(const fs::path& given) {
    const auto file = fs::absolute(given).lexically_normal();
    const auto find = [&](const std::string& name, const fs::path& by) -> std::optional<StageText> {
        const fs::path included = path_of(name, file, by);
        if (!check_plain_file(included)) return std::nullopt;
        return StageText{included, read_text(included, largest_text, "a file of Stage is wanted")};
    };
    const std::string text = read_text(file, largest_text, "name a world of Stage");
    return StageScene{file, parse_stage({file, text}, find)}.finish();
}

glm::dvec3 stage_size_m(const StageEntity& entity, const StageUnits& units) {
    glm::dvec3 size_m{0.4, 0.4, 1.0};
    const auto said = entity.numbers("size");
    for (std::size_t i = 0; i < std::min<std::size_t>(said.size(), 3); ++i)
        size_m[static_cast<int>(i)] = said[i] * units.metres;
    const bool fits = std::min({size_m.x, size_m.y, size_m.z}) > 0.0 && plausible_position(size_m);
    if (!fits) throw std::invalid_argument("every size must be above 0 and up to 1e7 m");
    return size_m;
}

std::vector<Mesh> block_meshes(const StageEntity& entity, const glm::dvec3& size_m,
                               const StageUnits& units) {
    std::vector<Mesh> meshes;
    for (const StageEntity& child : entity.children) {
        if (child.type == "block") meshes.push_back(prism(child, units));
    }
    if (!meshes.empty()) fit(meshes, size_m);
    return meshes;
}

Mesh bitmap_mesh(std::string_view picture, const glm::dvec3& size_m, std::size_t most_triangles) {
    const CellGrid grid = dark_cells(read_map_image(picture));
    const WallSize unit{
        .cell_m = 1.0, .bottom_m = 0.0, .top_m = 1.0, .most_triangles = most_triangles};
    std::vector<Mesh> meshes{wall_mesh(grid, Cell::occupied, unit)};
    if (meshes.front().triangles.empty()) return {};
    fit(meshes, size_m);
    return std::move(meshes.front());
}

}  // namespace scipd::sim
