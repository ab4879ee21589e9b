// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/mvsim/mvsim_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "sim/loaders/file/load_error.h"
#include "sim/loaders/file/plain_file.h"
#include "sim/loaders/file/scene_draft.h"
#include "sim/loaders/mvsim/mvsim_ground.h"
#include "sim/loaders/mvsim/mvsim_walk.h"
#include "sim/text/free_names.h"
#include "sim/text/quote.h"
#include "sim/world/extrusion.h"
#include "sim/world/reach.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t largest_mvsim_text = 16U << 20U;
constexpr std::uintmax_t largest_mvsim_picture = 512U << 20U;
constexpr std::size_t most_mvsim_triangles = 20'000'000;

bool is_one_of(const std::string& name, std::initializer_list<std::string_view> names) {
    return std::ranges::find(names, name) != names.end();
}

Outline regular_polygon(double radius_m, double corners) {
    if (!(radius_m > 0.0 && radius_m <= position_limit_m && corners >= 3.0 && corners <= 1000.0))
        throw std::invalid_argument("wants a radius and 3 to 1000 corners");
    Outline outline;
    const int count = static_cast<int>(corners);
    for (int i = 0; i < count; ++i) {
        const double angle_rad = 2.0 * std::numbers::pi * i / count;
        outline.emplace_back(radius_m * std::cos(angle_rad), radius_m * std::sin(angle_rad));
    }
    return outline;
}

class MvsimScene {
  public:
    MvsimScene(const fs::path& file, const MapOptions& options)
        : draft_(file, false, {}), options_(options) {
        draft_.set_name(file.stem().stem().string());
    }

    void visit(const MvsimNode& node) {
        const std::string kind = node.name();
        if (kind == "element") return add_element(node);
        if (kind == "block") return add_block(node);
        if (kind == "walls") return add_walls(node);
        if (kind == "vehicle") throw std::invalid_argument("is a robot; configure it in scipd");
        const bool says_nothing =
            is_one_of(kind, {"gui", "lights", "sensor", "vehicle:class", "joint"});
        // An element with nothing but text is a parameter.
        if (!says_nothing && node.has_children()) throw std::invalid_argument("is not known here");
    }

    void leave_out(const std::string& what) { draft_.leave_out(what); }

    LoadedScene finish() && { return std::move(draft_).finish("shape"); }

  private:
    void add_element(const MvsimNode& node) {
        const std::string kind = node.attribute("class");
        if (kind == "horizontal_plane") return add_plane(node);
        if (kind == "vertical_plane") return add_boxes(node, kind, node.pose(), plane_boxes(node));
        if (kind == "occupancy_grid") return add_grid(node);
        if (kind == "elevation_map") return add_elevation(node);
        if (is_one_of(kind, {"ground_grid", "skybox", "property_region"})) return;
        throw std::invalid_argument("class " + quote(kind) + " is not known here");
    }

    void add_plane(const MvsimNode& node) {
        const glm::dvec2 low_m{node.number("x_min", -10.0), node.number("y_min", -10.0)};
        const glm::dvec2 high_m{node.number("x_max", 10.0), node.number("y_max", 10.0)};
        const Plane plane{high_m - low_m};
        const bool fits = plane.size_m.x > 0.0 && plane.size_m.y > 0.0 &&
                          plausible_position({low_m, node.number("z", 0.0)}) &&
                          plausible_position({high_m, 0.0});
        if (!fits) throw std::invalid_argument("must be larger than 0 and within 1e7 m");
        const Pose middle{{0.5 * (low_m + high_m), node.number("z", 0.0)}, {1.0, 0.0, 0.0, 0.0}};
        const ModelId model = add_model(node, "horizontal_plane", node.pose(), false);
        add_object(model, middle, plane, "");
    }

    void add_boxes(const MvsimNode& node, const std::string& kind, const Pose& pose,
                   const std::vector<PlacedBox>& boxes) {
        const ModelId model = add_model(node, kind, pose, false);
        for (const PlacedBox& placed : boxes)
            add_object(model, placed.world_from_box, placed.box, options_.material);
    }

    void add_walls(const MvsimNode& node) {
        if (!node.has("shape") && node.has("model_uri"))
            throw std::invalid_argument("of a 3D model are not read; give them a <shape>");
        add_boxes(node, "walls", Pose{}, wall_boxes(node));
    }

    /// As in MVSim, a picture goes before a matrix.
    void add_elevation(const MvsimNode& node) {
        if (node.has("apply_kernel")) {
            draft_.warn(node.place() +
                        ": <apply_kernel> is not read; the heights are not smoothed");
        }
        const std::string image = node.text("elevation_image").value_or("");
        if (!image.empty()) {
            return add_mesh(node, "elevation_map",
                            elevation_mesh(node, picture(node.beside(image))));
        }
        const auto matrix = node.text("elevation_data_matrix");
        if (matrix) return add_mesh(node, "elevation_map", matrix_mesh(node, *matrix));
        throw std::invalid_argument(
            "wants an <elevation_image> or an <elevation_data_matrix>" +
            std::string{node.has("dem_xyzrgb_file") ? "; a <dem_xyzrgb_file> is not read" : ""});
    }

    void add_grid(const MvsimNode& node) {
        const std::string name = node.text("file").value_or("");
        if (name.empty()) throw std::invalid_argument("wants a <file>: a picture or a ROS map");
        const fs::path file = node.beside(name);
        const fs::path extension = file.extension();
        if (extension == ".yaml" || extension == ".yml") return add_ros_map(node, file);
        if (extension == ".gridmap" || extension == ".gz")
            throw std::invalid_argument("of MRPT's own format is not read; save it as a picture");
        if (!node.has("centerpixel_x") || !node.has("centerpixel_y")) {
            draft_.warn(node.place() +
                        ": has no centerpixel_x and _y; the middle of its picture is the origin");
        }
        PlacedMesh walls = grid_mesh(node, picture(file), options_.bottom_m, options_.top_m);
        if (!walls.mesh.triangles.empty())
            return add_mesh(node, "occupancy_grid", std::move(walls));
        draft_.warn(node.place() + ": " + printable(file.string(), whole_path) +
                    " has no dark pixel, and so no wall");
    }

    void add_ros_map(const MvsimNode& node, const fs::path& file) {
        try {
            const LoadedScene map = load_ros_map(file, options_);
            for (const std::string& warning : map.warnings)
                draft_.warn(warning);
            const Model& there = map.scene->models.front();
            const ModelId model = add_model(node, "occupancy_grid", there.world_from_model, false);
            for (const Object& object : map.scene->objects) {
                add_object(model, object.model_from_object, object.shape,
                           map.scene->materials[object.material].name);
            }
        } catch (const LoadError& wrong) {
            throw std::invalid_argument(wrong.what());
        }
    }

    void add_block(const MvsimNode& node) {
        const double bottom_m = node.number("zmin", 0.0);
        const double top_m = node.number("zmax", 1.0);
        const auto visual = node.child("visual");
        const std::string uri = visual ? visual->text("model_uri").value_or("") : "";
        const auto geometry = node.child("geometry");
        if (!node.has("shape") && !geometry && !uri.empty()) {
            throw std::invalid_argument("is shown by " + quote(uri) +
                                        ", and 3D models are not read; give it a <shape>");
        }
        if (!uri.empty()) {
            draft_.warn(visual->place() + ": " + quote(uri) + " is not read; the shape counts");
        }
        if (!(bottom_m < top_m) || !plausible_position({bottom_m, top_m, 0.0}))
            throw std::invalid_argument("zmin must be below zmax");
        const Shape shape = block_shape(node, geometry, top_m - bottom_m);
        const ModelId model = add_model(node, "block", node.pose(), !node.is_on("static"));
        // The origin of a primitive is its centre, that of a prism lies in its foot.
        const bool is_prism = std::holds_alternative<SharedMesh>(shape);
        const double z_m = is_prism ? bottom_m : 0.5 * (bottom_m + top_m);
        add_object(model, {{0.0, 0.0, z_m}, {1.0, 0.0, 0.0, 0.0}}, shape, "");
    }

    Shape block_shape(const MvsimNode& node, const std::optional<MvsimNode>& geometry,
                      double height_m) {
        if (const Outline outline = node.points(); !outline.empty()) {
            if (outline.size() < 3 || outline.size() > 1000)
                throw std::invalid_argument("<shape> wants 3 to 1000 points");
            return prism(outline, height_m);
        }
        if (!geometry) return Box{{1.0, 1.0, height_m}};
        const std::string kind = geometry->attribute("type");
        if (kind != "cylinder")
            throw std::invalid_argument("of the geometry " + quote(kind) + " is not read");
        const double radius_m = geometry->attribute_or_child("radius", 0.0);
        return prism(regular_polygon(radius_m, geometry->attribute_or_child("vertex_count", 32.0)),
                     geometry->attribute_or_child("length", height_m));
    }

    Shape prism(const Outline& outline, double height_m) {
        if (!(height_m > 0.0 && height_m <= position_limit_m))
            throw std::invalid_argument("must be higher than 0");
        return counted(extrusion_mesh({outline}, height_m));
    }

    SharedMesh counted(Mesh mesh) {
        if (mesh.triangles.size() > most_mvsim_triangles - triangles_)
            throw std::invalid_argument("brings the world to more than 20 million triangles");
        triangles_ += mesh.triangles.size();
        return std::make_shared<const Mesh>(std::move(mesh));
    }

    void add_mesh(const MvsimNode& node, const std::string& kind, PlacedMesh placed) {
        SharedMesh mesh = counted(std::move(placed.mesh));
        const ModelId model = add_model(node, kind, node.pose(), false);
        add_object(model, {placed.origin_m, {1.0, 0.0, 0.0, 0.0}}, std::move(mesh),
                   options_.material);
    }

    static std::string picture(const fs::path& file) {
        try {
            return read_file(file, largest_mvsim_picture, "a picture is wanted here");
        } catch (const LoadError& wrong) {
            throw std::invalid_argument(wrong.what());
        }
    }

    ModelId add_model(const MvsimNode& node, const std::string& kind, const Pose& pose,
                      bool movable) {
        const std::string said = node.attribute("name");
        return draft_.add(Model{names_.take(said.empty() ? kind : said), movable, pose});
    }

    void add_object(ModelId model, const Pose& pose, Shape shape, const std::string& material) {
        draft_.add({draft_.model(model).name + "::shape", model, pose, std::move(shape), 0},
                   {material});
    }

    SceneDraft draft_;
    MapOptions options_;
    FreeNames names_{'_', 2};
    std::size_t triangles_ = 0;
};

}  // namespace

LoadedScene load_mvsim(const fs::path& given, const MapOptions& options) {
    const auto file = fs::absolute(given).lexically_normal();
    const std::string text = read_text(file, largest_mvsim_text, "name a world of MVSim");
    MvsimScene scene{file, options};
    const MvsimVisitor visitor{.visit = [&](const MvsimNode& node) { scene.visit(node); },
                               .leave_out = [&](const std::string& what) { scene.leave_out(what); },
                               .read = [](const fs::path& included) -> std::optional<std::string> {
                                   if (!check_plain_file(included)) return std::nullopt;
                                   return read_text(included, largest_mvsim_text,
                                                    "a part of a world is wanted");
                               }};
    walk_mvsim(text, file, visitor);
    return std::move(scene).finish();
}

}  // namespace scipd::sim
