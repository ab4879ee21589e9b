// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/embree_movables.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>
#include <variant>

#include <glm/gtc/type_ptr.hpp>
#include <glm/mat4x3.hpp>

#include "sim/backends/embree_still.h"
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

EmbreeMovables::EmbreeMovables(const SharedScene& scene) : scene_(scene) {
    const std::vector<Model>& models = scene->models;
    if (std::ranges::none_of(models, &Model::movable)) return;
    device_ = new_device();
    moving_ = new_scene(device_.get());
    bodies_ = EmbreeBodies{device_.get(), *scene};
    movables_.resize(models.size());
    for (ModelId id = 0; id < models.size(); ++id) {
        if (bodies_.of(id) == nullptr) continue;
        Movable& movable = movables_[id];
        movable.instance.reset(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE));
        rtcSetGeometryInstancedScene(movable.instance.get(), bodies_.of(id));
        rtcDisableGeometry(movable.instance.get());
        rtcAttachGeometryByID(moving_.get(), movable.instance.get(), id);
        instances_.push_back(id);
        move(id, models[id].world_from_model);
    }
    require_built(device_.get(), *scene);
}

void EmbreeMovables::move(ModelId model, const Pose& world_from_model) {
    Movable& movable = movables_[model];
    movable.world_from_model = glm::mat3_cast(world_from_model.rotation);
    movable.anchored_at_m = anchored(*scene_, world_from_model).translation_m;
    movable.moved = true;
}

void EmbreeMovables::place(Movable& movable) {
    const glm::mat3& turned = movable.world_from_model;
    const glm::mat4x3 anchored_from_model{turned[0], turned[1], turned[2], movable.anchored_at_m};
    rtcSetGeometryTransform(movable.instance.get(), 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR,
                            glm::value_ptr(anchored_from_model));
    rtcCommitGeometry(movable.instance.get());
    movable.moved = false;
}

// A commit costs as much for each instance that is in the scene, moved or not, and so do rays.
void EmbreeMovables::show(std::span<const ModelId> models) {
    bool changed = false;
    ++shows_;
    for (const ModelId model : models) {
        Movable& movable = movables_[model];
        if (!movable.instance) continue;
        movable.asked = shows_;
        changed |= movable.moved || !movable.shown;
        if (movable.moved) place(movable);
        if (movable.shown) continue;
        rtcEnableGeometry(movable.instance.get());
        movable.shown = true;
        shown_.push_back(model);
    }
    changed |= std::erase_if(shown_, [this](ModelId model) {
                   Movable& movable = movables_[model];
                   if (movable.asked == shows_) return false;
                   rtcDisableGeometry(movable.instance.get());
                   movable.shown = false;
                   return true;
               }) > 0;
    if (changed) rtcCommitScene(moving_.get());
}

void EmbreeMovables::trace(CoherentTracer& tracer, const int* valid, RTCRayHit16& packet) const {
    if (shown_.empty()) return;
    tracer.trace(valid, moving_.get(), packet);
    turn_normals(valid, packet);
}

void EmbreeMovables::turn_normals(const int* valid, RTCRayHit16& packet) const {
    for (std::size_t k = 0; k < packet_size; ++k) {
        if (valid[k] == 0) continue;
        const ModelId model = packet.hit.instID[0][k];
        if (model != RTC_INVALID_GEOMETRY_ID) set_normal(packet.hit, k, model, packet.hit);
    }
}

void EmbreeMovables::set_normal(RTCHit16& hit, std::size_t k, ModelId model,
                                const RTCHit16& in_model) const {
    const glm::vec3 normal = movables_[model].world_from_model *
                             glm::vec3{in_model.Ng_x[k], in_model.Ng_y[k], in_model.Ng_z[k]};
    hit.Ng_x[k] = normal.x;
    hit.Ng_y[k] = normal.y;
    hit.Ng_z[k] = normal.z;
}

void EmbreeMovables::trace_alone(ModelId model, CoherentTracer& tracer, const int* valid,
                                 RTCRayHit16& packet) const {
    const Movable& movable = movables_[model];
    if (!movable.instance) return;
    const glm::mat3 model_from_world = glm::transpose(movable.world_from_model);
    RTCRayHit16 local = packet;
    RTCRay16& ray = local.ray;
    for (std::size_t k = 0; k < packet_size; ++k) {
        const glm::vec3 origin_m{ray.org_x[k], ray.org_y[k], ray.org_z[k]};
        const glm::vec3 from_m = model_from_world * (origin_m - movable.anchored_at_m);
        const glm::vec3 direction =
            apart_from_zero(model_from_world * glm::vec3{ray.dir_x[k], ray.dir_y[k], ray.dir_z[k]});
        ray.org_x[k] = from_m.x;
        ray.org_y[k] = from_m.y;
        ray.org_z[k] = from_m.z;
        ray.dir_x[k] = direction.x;
        ray.dir_y[k] = direction.y;
        ray.dir_z[k] = direction.z;
    }
    std::ranges::fill(local.hit.geomID, RTC_INVALID_GEOMETRY_ID);
    tracer.trace(valid, bodies_.of(model), local);
    for (std::size_t k = 0; k < packet_size; ++k) {
        if (local.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID) continue;
        packet.ray.tfar[k] = ray.tfar[k];
        set_normal(packet.hit, k, model, local.hit);
        packet.hit.geomID[k] = local.hit.geomID[k];
        packet.hit.instID[0][k] = model;
    }
}

}  // namespace scipd::sim
