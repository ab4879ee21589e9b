// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/embree_geometry.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>

#include <glm/vec3.hpp>

#include "sim/world/shape.h"

namespace scipd::sim {
namespace {

/// Embree owns what it returns.
template <typename Element>
Element* new_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t count) {
    void* buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(Element), count);
    if (!buffer) throw std::runtime_error("Embree has no memory for the scene");
    return static_cast<Element*>(buffer);
}

}  // namespace

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
