// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tests/bench/bare_embree.h"

#include <algorithm>

#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x3.hpp>
#include <pmmintrin.h>

namespace scipd::sim {
namespace {

void intersect(RTCScene scene, const int* valid, RTCRayHit16& packet) {
#if SCIPD_EMBREE_MAJOR == 3
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect16(valid, scene, &context, &packet);
#else
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    rtcIntersect16(valid, scene, &packet, &arguments);
#endif
}

template <typename Element>
Element* new_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t count) {
    return static_cast<Element*>(
        rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(Element), count));
}

}  // namespace

BareEmbree::BareEmbree(const Scene& scene, Movables movables)
    : bodies_(scene.models.size()), anchor_m_(scene.anchor_m) {
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
    const Pose anchored_from_world{-anchor_m_, Pose{}.rotation};
    for (ObjectId id = 0; id < scene.objects.size(); ++id) {
        const Object& object = scene.objects[id];
        const Model& model = scene.models[object.model];
        material_of_.push_back(object.material);
        if (model.movable && movables == Movables::instances) {
            if (!bodies_[object.model]) bodies_[object.model] = new_scene();
            add(bodies_[object.model], id, object, object.model_from_object);
        } else {
            add(scene_, id, object,
                anchored_from_world * model.world_from_model * object.model_from_object);
        }
    }
    rtcCommitScene(scene_);
    for (ModelId id = 0; id < bodies_.size(); ++id) {
        if (bodies_[id]) add_instance(id, anchored_from_world * scene.models[id].world_from_model);
    }
    if (moving_) rtcCommitScene(moving_);
}

BareEmbree::~BareEmbree() {
    for (RTCScene body : bodies_) {
        if (body) rtcReleaseScene(body);
    }
    if (moving_) rtcReleaseScene(moving_);
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
}

void BareEmbree::cast(std::span<const glm::vec3> directions, std::span<const Pose> poses,
                      float max_range_m, std::span<float> range_m,
                      std::span<MaterialId> materials) const {
    RTCRayHit16 packet{};
    std::fill_n(packet.ray.mask, 16, ~0U);
    glm::mat3 rotation{glm::mat3_cast(poses[0].rotation)};
    glm::vec3 origin_m{poses[0].translation_m - anchor_m_};
    for (std::size_t first = 0; first < directions.size(); first += 16) {
        const std::size_t count = std::min<std::size_t>(16, directions.size() - first);
        alignas(64) int valid[16] = {};
        for (std::size_t k = 0; k < count; ++k) {
            if (poses.size() > 1) {
                rotation = glm::mat3_cast(poses[first + k].rotation);
                origin_m = poses[first + k].translation_m - anchor_m_;
            }
            const glm::vec3 direction = rotation * directions[first + k];
            valid[k] = -1;
            packet.ray.org_x[k] = origin_m.x;
            packet.ray.org_y[k] = origin_m.y;
            packet.ray.org_z[k] = origin_m.z;
            packet.ray.dir_x[k] = direction.x;
            packet.ray.dir_y[k] = direction.y;
            packet.ray.dir_z[k] = direction.z;
            packet.ray.tfar[k] = max_range_m;
            packet.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
        }
        intersect(scene_, valid, packet);
        if (moving_) intersect(moving_, valid, packet);
        std::copy_n(packet.ray.tfar, count, range_m.begin() + static_cast<std::ptrdiff_t>(first));
        if (materials.empty()) continue;
        for (std::size_t k = 0; k < count; ++k) {
            const unsigned id = packet.hit.geomID[k];
            materials[first + k] = id == RTC_INVALID_GEOMETRY_ID ? 0 : material_of_[id];
        }
    }
}

RTCScene BareEmbree::new_scene() const {
    RTCScene scene = rtcNewScene(device_);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    return scene;
}

void BareEmbree::add(RTCScene scene, ObjectId id, const Object& object,
                     const Pose& here_from_object) {
    const Mesh mesh = tessellate(object.shape);
    if (mesh.triangles.empty()) return;
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = new_buffer<glm::vec3>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3,
                                           mesh.vertices_m.size());
    auto* triangles = new_buffer<glm::uvec3>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3,
                                             mesh.triangles.size());
    std::ranges::transform(mesh.vertices_m, vertices, [&](const glm::vec3& vertex) {
        return glm::vec3{here_from_object * glm::dvec3{vertex}};
    });
    std::ranges::copy(mesh.triangles, triangles);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, id);
    rtcReleaseGeometry(geometry);
}

void BareEmbree::add_instance(ModelId id, const Pose& anchored_from_model) {
    rtcCommitScene(bodies_[id]);
    const glm::mat3 turn{glm::mat3_cast(anchored_from_model.rotation)};
    const glm::mat4x3 placed{turn[0], turn[1], turn[2],
                             glm::vec3{anchored_from_model.translation_m}};
    RTCGeometry instance = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, bodies_[id]);
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, glm::value_ptr(placed));
    rtcCommitGeometry(instance);
    if (!moving_) moving_ = new_scene();
    rtcAttachGeometryByID(moving_, instance, id);
    rtcReleaseGeometry(instance);
}

}  // namespace scipd::sim
