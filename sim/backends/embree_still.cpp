// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/embree_still.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <mutex>
#include <stdexcept>

#include <glm/vec3.hpp>

#include "sim/world/shape.h"

namespace scipd::sim {
namespace {

std::shared_ptr<const EmbreeStill> make_still_part(const SharedScene& scene) {
    auto still = std::make_shared<EmbreeStill>();
    still->of = scene;
    still->device = new_device();
    still->scene = new_scene(still->device.get());
    for (ObjectId id = 0; id < scene->objects.size(); ++id) {
        const Object& object = scene->objects[id];
        const Model& model = scene->models[object.model];
        if (model.movable) continue;
        attach(still->device.get(), still->scene.get(), id, object,
               anchored(*scene, model.world_from_model * object.model_from_object));
    }
    rtcCommitScene(still->scene.get());
    require_built(still->device.get(), *scene);
    return still;
}

/// Embree owns what it returns.
template <typename Element>
Element* new_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t count) {
    void* buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(Element), count);
    if (!buffer) throw std::runtime_error("Embree has no memory for the scene");
    return static_cast<Element*>(buffer);
}

}  // namespace

// Backends are made where nobody waits for scans, so a lock disturbs none. What is held keeps its
// scene, so no other scene can have the same address.
std::shared_ptr<const EmbreeStill> still_part(const SharedScene& scene) {
    static std::mutex mutex;
    static std::map<const Scene*, std::weak_ptr<const EmbreeStill>> made;
    const std::scoped_lock lock(mutex);
    std::erase_if(made, [](const auto& entry) { return entry.second.expired(); });
    std::weak_ptr<const EmbreeStill>& known = made[scene.get()];
    auto still = known.lock();
    if (!still) known = still = make_still_part(scene);
    return still;
}

void require_built(RTCDevice device, const Scene& scene) {
    if (rtcGetDeviceError(device) != RTC_ERROR_NONE)
        throw std::runtime_error("Embree cannot build the scene " + scene.name);
}

void attach(RTCDevice device, RTCScene scene, ObjectId id, const Object& object,
            const Pose& here_from_object, RTCFilterFunctionN filter) {
    const Mesh mesh = tessellate(object.shape);
    if (mesh.triangles.empty()) return;
    const GeometryHandle geometry{rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE)};
    auto* vertices = new_buffer<glm::vec3>(geometry.get(), RTC_BUFFER_TYPE_VERTEX,
                                           RTC_FORMAT_FLOAT3, mesh.vertices_m.size());
    auto* triangles = new_buffer<glm::uvec3>(geometry.get(), RTC_BUFFER_TYPE_INDEX,
                                             RTC_FORMAT_UINT3, mesh.triangles.size());
    std::ranges::transform(mesh.vertices_m, vertices, [&](const glm::vec3& vertex) {
        return glm::vec3{here_from_object * glm::dvec3{vertex}};
    });
    std::ranges::copy(mesh.triangles, triangles);
    rtcSetGeometryIntersectFilterFunction(geometry.get(), filter);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometryByID(scene, geometry.get(), id);
}

}  // namespace scipd::sim
