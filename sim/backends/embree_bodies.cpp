// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/embree_bodies.h"

#include <map>
#include <utility>
#include <variant>

#include "sim/backends/embree_geometry.h"
#include "sim/world/shape.h"

namespace scipd::sim {
namespace {

/// Tells bodies apart: equal numbers, equal geometry.
class Numbers {
  public:
    using List = std::vector<double>;

    List of(const Scene& scene, const std::vector<ObjectId>& objects) {
        list_.clear();
        for (const ObjectId id : objects) {
            const Object& object = scene.objects[id];
            list_.push_back(static_cast<double>(object.shape.index()));
            std::visit(*this, object.shape);
            const auto& [place_m, rotation] = object.model_from_object;
            list_.insert(list_.end(), {place_m.x, place_m.y, place_m.z, rotation.w, rotation.x,
                                       rotation.y, rotation.z});
        }
        return list_;
    }

    void operator()(const Box& box) { add({box.size_m.x, box.size_m.y, box.size_m.z}); }
    void operator()(const Cylinder& rod) { add({rod.radius_m, rod.length_m}); }
    void operator()(const Sphere& ball) { add({ball.radius_m}); }
    void operator()(const Plane& plane) { add({plane.size_m.x, plane.size_m.y}); }
    void operator()(const SharedMesh& mesh) {
        const auto known = meshes_.try_emplace(mesh.get(), meshes_.size());
        add({static_cast<double>(known.first->second)});
    }

  private:
    void add(std::initializer_list<double> numbers) { list_.insert(list_.end(), numbers); }

    List list_;
    std::map<const Mesh*, std::size_t> meshes_;
};

SceneHandle make_body(RTCDevice device, const Scene& scene, const std::vector<ObjectId>& objects) {
    SceneHandle body = new_scene(device);
    for (unsigned i = 0; i < objects.size(); ++i) {
        const Object& object = scene.objects[objects[i]];
        attach(device, body.get(), i, object, object.model_from_object, look_through);
    }
    rtcCommitScene(body.get());
    return body;
}

}  // namespace

EmbreeBodies::EmbreeBodies(RTCDevice device, const Scene& scene) : by_model_(scene.models.size()) {
    for (ObjectId id = 0; id < scene.objects.size(); ++id) {
        const ModelId model = scene.objects[id].model;
        if (scene.models[model].movable) by_model_[model].objects.push_back(id);
    }
    Numbers numbers;
    std::map<Numbers::List, RTCScene> made;
    for (Body& body : by_model_) {
        if (body.objects.empty()) continue;
        RTCScene& known = made[numbers.of(scene, body.objects)];
        if (known == nullptr) {
            scenes_.push_back(make_body(device, scene, body.objects));
            known = scenes_.back().get();
        }
        body.scene = known;
    }
}

}  // namespace scipd::sim
