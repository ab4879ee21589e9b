// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/reader/scene_answer.h"

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "sim/loaders/file/between_processes.h"
#include "sim/world/script.h"

namespace scipd::sim {
namespace {

void put_script(const Script& script, std::FILE* out) {
    put_all(script.steps, out);
    put(script.lap, out);
}

SharedScript take_script(std::FILE* in) {
    Script script;
    script.steps = take_all<std::vector<Script::Step>>(in);
    script.lap = take<Time>(in);
    if (script.steps.empty()) refuse_data();
    return std::make_shared<const Script>(std::move(script));
}

void put_model(const Model& model, std::FILE* out) {
    put_all(model.name, out);
    put(model.movable, out);
    put(model.world_from_model, out);
    put(model.script != nullptr, out);
    if (model.script) put_script(*model.script, out);
}

Model take_model(std::FILE* in) {
    Model model;
    model.name = take_all<std::string>(in);
    model.movable = take_bool(in);
    model.world_from_model = take<Pose>(in);
    if (take_bool(in)) model.script = take_script(in);
    return model;
}

void put_frame(const Frame& frame, std::FILE* out) {
    put_all(frame.name, out);
    put(frame.model, out);
    put(frame.model_from_frame, out);
    put_all(frame.sensor, out);
    put_optional(frame.lidar, out);
}

Frame take_frame(std::FILE* in) {
    Frame frame;
    frame.name = take_all<std::string>(in);
    frame.model = take<ModelId>(in);
    frame.model_from_frame = take<Pose>(in);
    frame.sensor = take_all<std::string>(in);
    frame.lidar = take_optional<Lidar>(in);
    return frame;
}

void put_material(const Material& material, std::FILE* out) {
    put_all(material.name, out);
    const Appearance& appearance = material.appearance;
    for (const auto& number : {material.laser_retro, appearance.transparency, appearance.metalness,
                               appearance.roughness})
        put_optional(number, out);
    put(material.from_script, out);
}

Material take_material(std::FILE* in) {
    Material material;
    material.name = take_all<std::string>(in);
    Appearance& appearance = material.appearance;
    for (auto* number : {&material.laser_retro, &appearance.transparency, &appearance.metalness,
                         &appearance.roughness})
        *number = take_optional<double>(in);
    material.from_script = take_bool(in);
    return material;
}

void put_mesh(const SharedMesh& mesh, std::FILE* out) {
    put_all(mesh->vertices_m, out);
    put_all(mesh->triangles, out);
}

SharedMesh take_mesh(std::FILE* in) {
    Mesh mesh;
    mesh.vertices_m = take_all<std::vector<glm::vec3>>(in);
    mesh.triangles = take_all<std::vector<glm::uvec3>>(in);
    const auto vertices = mesh.vertices_m.size();
    if (!std::ranges::all_of(mesh.triangles, [&](const glm::uvec3& corners) {
            return corners.x < vertices && corners.y < vertices && corners.z < vertices;
        }))
        refuse_data();
    return std::make_shared<const Mesh>(std::move(mesh));
}

/// A shape with the index of its mesh in place of the mesh, since many objects may share one mesh.
using Plain = std::variant<Box, Cylinder, Sphere, Plane, std::uint64_t>;

void put_plain(const Plain& plain, std::FILE* out) {
    put(std::uint64_t{plain.index()}, out);
    std::visit([&](const auto& shape) { put(shape, out); }, plain);
}

Plain take_plain(std::FILE* in) {
    switch (take<std::uint64_t>(in)) {
        case 0:
            return take<Box>(in);
        case 1:
            return take<Cylinder>(in);
        case 2:
            return take<Sphere>(in);
        case 3:
            return take<Plane>(in);
        case 4:
            return take<std::uint64_t>(in);
        default:
            refuse_data();
    }
}

class Sender {
  public:
    explicit Sender(std::FILE* out) : out_(out) {}

    void send(const Scene& scene) {
        put_all(scene.name, out_);
        put(scene.anchor_m, out_);
        put_each(scene.models, out_, put_model);
        put_each(scene.frames, out_, put_frame);
        put_each(scene.materials, out_, put_material);
        put_each(scene.objects, out_, [&](const Object& object, std::FILE*) { send(object); });
        put_each(meshes_, out_, put_mesh);
    }

  private:
    void send(const Object& object) {
        put_all(object.name, out_);
        put(object.model, out_);
        put(object.model_from_object, out_);
        put(object.material, out_);
        put_plain(std::visit([&](const auto& shape) { return plain(shape); }, object.shape), out_);
    }

    template <typename Primitive>
    Plain plain(const Primitive& shape) {
        return shape;
    }
    Plain plain(const SharedMesh& mesh) {
        const auto [known, is_new] = index_of_.emplace(mesh.get(), meshes_.size());
        if (is_new) meshes_.push_back(mesh);
        return known->second;
    }

    std::FILE* out_;
    std::vector<SharedMesh> meshes_;
    std::map<const Mesh*, std::uint64_t> index_of_;
};

class Receiver {
  public:
    explicit Receiver(std::FILE* in) : in_(in) {}

    Scene receive() {
        scene_.name = take_all<std::string>(in_);
        scene_.anchor_m = take<glm::dvec3>(in_);
        scene_.models = take_each<std::vector<Model>>(in_, take_model);
        scene_.frames = take_each<std::vector<Frame>>(in_, take_frame);
        scene_.materials = take_each<std::vector<Material>>(in_, take_material);
        std::vector<Plain> shapes;
        scene_.objects = take_each<std::vector<Object>>(in_, [&](std::FILE*) {
            Object object = take_object();
            shapes.push_back(take_plain(in_));
            return object;
        });
        meshes_ = take_each<std::vector<SharedMesh>>(in_, take_mesh);
        for (std::size_t i = 0; i < shapes.size(); ++i)
            scene_.objects[i].shape = shape_of(shapes[i]);
        check();
        return std::move(scene_);
    }

  private:
    Object take_object() {
        Object object;
        object.name = take_all<std::string>(in_);
        object.model = take<ModelId>(in_);
        object.model_from_object = take<Pose>(in_);
        object.material = take<MaterialId>(in_);
        return object;
    }

    [[nodiscard]] Shape shape_of(const Plain& plain) const {
        const auto whole = [&](const auto& shape) -> Shape {
            if constexpr (std::is_same_v<decltype(shape), const std::uint64_t&>) {
                if (shape >= meshes_.size()) refuse_data();
                return meshes_[shape];
            } else {
                return shape;
            }
        };
        return std::visit(whole, plain);
    }

    void check() const {
        const auto has_model = [&](const auto& thing) {
            return thing.model < scene_.models.size();
        };
        const auto has_material = [&](const Object& object) {
            return object.material < scene_.materials.size();
        };
        if (scene_.materials.empty() || !std::ranges::all_of(scene_.frames, has_model) ||
            !std::ranges::all_of(scene_.objects, has_model) ||
            !std::ranges::all_of(scene_.objects, has_material))
            refuse_data();
    }

    std::FILE* in_;
    Scene scene_;
    std::vector<SharedMesh> meshes_;
};

}  // namespace

void put_scene(const Scene& scene, std::FILE* out) {
    Sender{out}.send(scene);
}

Scene take_scene(std::FILE* in) {
    return Receiver{in}.receive();
}

}  // namespace scipd::sim
