// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/confined_scene.h"

#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

#include "sim/loaders/file/between_processes.h"
#include "sim/loaders/file/confined.h"
#include "sim/loaders/file/load_error.h"
#include "sim/world/script.h"

namespace scipd::sim {
namespace {

using Texts = std::vector<std::string>;

void put_texts(const Texts& texts, std::FILE* out) {
    put_each(texts, out, put_all<std::string>);
}

Texts take_texts(std::FILE* in) {
    return take_each<Texts>(in, take_all<std::string>);
}

void put_script(const Script& script, std::FILE* out) {
    put_all(script.steps, out);
    put(script.lap, out);
}

SharedScript take_script(std::FILE* in) {
    Script script;
    script.steps = take_all<std::vector<Script::Step>>(in);
    script.lap = take<Time>(in);
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
    model.movable = take<bool>(in);
    model.world_from_model = take<Pose>(in);
    if (take<bool>(in)) model.script = take_script(in);
    return model;
}

void put_frame(const Frame& frame, std::FILE* out) {
    put_all(frame.name, out);
    put(frame.model, out);
    put(frame.model_from_frame, out);
    put_all(frame.sensor, out);
    put(frame.lidar, out);
}

Frame take_frame(std::FILE* in) {
    Frame frame;
    frame.name = take_all<std::string>(in);
    frame.model = take<ModelId>(in);
    frame.model_from_frame = take<Pose>(in);
    frame.sensor = take_all<std::string>(in);
    frame.lidar = take<std::optional<Lidar>>(in);
    return frame;
}

void put_material(const Material& material, std::FILE* out) {
    put_all(material.name, out);
    put(material.laser_retro, out);
    put(material.appearance, out);
    put(material.from_script, out);
}

Material take_material(std::FILE* in) {
    Material material;
    material.name = take_all<std::string>(in);
    material.laser_retro = take<std::optional<double>>(in);
    material.appearance = take<Appearance>(in);
    material.from_script = take<bool>(in);
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
    return std::make_shared<const Mesh>(std::move(mesh));
}

/// A shape with the index of its mesh in place of the mesh, since many objects may share one mesh.
using Plain = std::variant<Box, Cylinder, Sphere, Plane, std::size_t>;

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
        put(std::visit([&](const auto& shape) { return plain(shape); }, object.shape), out_);
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
    std::map<const Mesh*, std::size_t> index_of_;
};

class Receiver {
  public:
    explicit Receiver(std::FILE* in) : in_(in) {}

    Scene receive() {
        Scene scene;
        scene.name = take_all<std::string>(in_);
        scene.anchor_m = take<glm::dvec3>(in_);
        scene.models = take_each<std::vector<Model>>(in_, take_model);
        scene.frames = take_each<std::vector<Frame>>(in_, take_frame);
        scene.materials = take_each<std::vector<Material>>(in_, take_material);
        std::vector<Plain> shapes;
        scene.objects = take_each<std::vector<Object>>(in_, [&](std::FILE*) {
            Object object = take_object();
            shapes.push_back(take<Plain>(in_));
            return object;
        });
        const auto meshes = take_each<std::vector<SharedMesh>>(in_, take_mesh);
        for (std::size_t i = 0; i < shapes.size(); ++i)
            scene.objects[i].shape = shape_of(shapes[i], meshes);
        return scene;
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

    static Shape shape_of(const Plain& plain, const std::vector<SharedMesh>& meshes) {
        const auto whole = [&](const auto& shape) -> Shape {
            if constexpr (std::is_same_v<decltype(shape), const std::size_t&>) {
                return meshes.at(shape);
            } else {
                return shape;
            }
        };
        return std::visit(whole, plain);
    }

    std::FILE* in_;
};

void work(std::FILE* out, const LoadLimits& limits, const std::function<LoadedScene()>& load) {
    try {
        if (limits.folders) read_only_from(*limits.folders);
        const LoadedScene loaded = load();
        put(true, out);
        put_texts(loaded.warnings, out);
        Sender{out}.send(*loaded.scene);
    } catch (const LoadError& error) {
        put(false, out);
        put_texts(error.faults(), out);
    }
}

}  // namespace

LoadedScene load_confined(const std::string& name, const LoadLimits& limits,
                          const std::function<LoadedScene()>& load) {
    try {
        // Longer than one thread can use within wall_time: so the wall time ends the child first,
        // and the message is about that.
        const auto processor_time = limits.wall_time + std::chrono::seconds{10};
        const Confines confines{
            .processor_time = processor_time,
            .memory_bytes = limits.memory_bytes,
            .wall_time = limits.wall_time,
            .stop = limits.stop,
            .more_memory = {},
            .more_time = "world_load_s under limits in the configuration allows more"};
        const File answer =
            run_confined(confines, [&](std::FILE* out) { work(out, limits, load); });
        const bool is_loaded = take<bool>(answer.get());
        Texts texts = take_texts(answer.get());
        if (!is_loaded) throw LoadError(std::move(texts));
        return {std::make_shared<const Scene>(Receiver{answer.get()}.receive()), std::move(texts)};
    } catch (const LoadError&) {
        throw;
    } catch (const std::runtime_error& wrong) {
        throw LoadError({name + ": " + wrong.what()});
    }
}

}  // namespace scipd::sim
