// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The yardstick: the shortest loop around rtcIntersect16 that turns directions into ranges. One
// static robust scene, one mesh an object, coherent packets; no material, no incidence, no movable
// models, no checks.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include <pmmintrin.h>

#if SCIPD_EMBREE_MAJOR == 3
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

#include <glm/mat3x3.hpp>

#include "sim/world/scene.h"

namespace scipd::sim {

class BareEmbree {
  public:
    explicit BareEmbree(const Scene& scene) : anchor_m_(scene.anchor_m) {
        _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
        _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
        rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
        for (const Object& object : scene.objects) {
            add(tessellate(object.shape),
                scene.models[object.model].world_from_model * object.model_from_object);
        }
        rtcCommitScene(scene_);
    }
    BareEmbree(const BareEmbree&) = delete;
    BareEmbree& operator=(const BareEmbree&) = delete;
    ~BareEmbree() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }

    /// As many poses as directions, or one.
    void cast(std::span<const glm::vec3> directions, std::span<const Pose> poses, float max_range_m,
              std::span<float> range_m) const {
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
            intersect(valid, packet);
            std::copy_n(packet.ray.tfar, count,
                        range_m.begin() + static_cast<std::ptrdiff_t>(first));
        }
    }

  private:
    void intersect(const int* valid, RTCRayHit16& packet) const {
#if SCIPD_EMBREE_MAJOR == 3
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        rtcIntersect16(valid, scene_, &context, &packet);
#else
        RTCIntersectArguments arguments;
        rtcInitIntersectArguments(&arguments);
        arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
        rtcIntersect16(valid, scene_, &packet, &arguments);
#endif
    }

    void add(const Mesh& mesh, const Pose& world_from_mesh) {
        RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* vertices = static_cast<glm::vec3*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                    sizeof(glm::vec3), mesh.vertices_m.size()));
        auto* triangles = static_cast<glm::uvec3*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                    sizeof(glm::uvec3), mesh.triangles.size()));
        std::ranges::transform(mesh.vertices_m, vertices, [&](const glm::vec3& vertex) {
            return glm::vec3{world_from_mesh * glm::dvec3{vertex} - anchor_m_};
        });
        std::ranges::copy(mesh.triangles, triangles);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);
    }

    glm::dvec3 anchor_m_;
    RTCDevice device_ = rtcNewDevice("threads=1");
    RTCScene scene_ = rtcNewScene(device_);
};

}  // namespace scipd::sim
