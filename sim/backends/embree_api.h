// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Embree as the files embree*.cpp use it: handles that release themselves, packets of 16, and all
// that differs between versions 3 and 4. Included by these files only.
#pragma once

#include <cmath>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>

#include <pmmintrin.h>
#include <xmmintrin.h>

#if SCIPD_EMBREE_MAJOR == 3
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

#include <glm/vec3.hpp>

#include "sim/world/scene.h"

namespace scipd::sim {

inline constexpr std::size_t packet_size = 16;

struct Release {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
    void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using DeviceHandle = std::unique_ptr<RTCDeviceTy, Release>;
using SceneHandle = std::unique_ptr<RTCSceneTy, Release>;
using GeometryHandle = std::unique_ptr<RTCGeometryTy, Release>;

/// Embree is several times slower where denormal numbers are kept. They are kept again when this
/// goes.
class DenormalsAsZero {
  public:
    DenormalsAsZero() {
        _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
        _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
    }
    DenormalsAsZero(const DenormalsAsZero&) = delete;
    ~DenormalsAsZero() { _mm_setcsr(before_); }

  private:
    unsigned before_ = _mm_getcsr();
};

/// What Embree hands to filters: of its own, and which instance is looked through.
#if SCIPD_EMBREE_MAJOR == 3
struct Query : RTCIntersectContext {
#else
struct Query : RTCRayQueryContext {
#endif
    ModelId unseen = no_model;
};

/// Traces packets whose rays are neighbours: two to three times as fast as rays that nothing is
/// known about.
struct CoherentTracer {
    Query query;
#if SCIPD_EMBREE_MAJOR == 3
    explicit CoherentTracer(ModelId unseen) {
        rtcInitIntersectContext(&query);
        query.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        query.unseen = unseen;
    }
    void trace(const int* valid, RTCScene scene, RTCRayHit16& packet) {
        rtcIntersect16(valid, scene, &query, &packet);
    }
#else
    RTCIntersectArguments arguments;
    explicit CoherentTracer(ModelId unseen) {
        rtcInitRayQueryContext(&query);
        query.unseen = unseen;
        rtcInitIntersectArguments(&arguments);
        arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
        arguments.context = &query;
    }
    void trace(const int* valid, RTCScene scene, RTCRayHit16& packet) {
        rtcIntersect16(valid, scene, &packet, &arguments);
    }
#endif
};

/// On the faces of movable models: lets rays through the one that their fan does not see. Instances
/// are their models' ids.
inline void look_through(const RTCFilterFunctionNArguments* hits) {
    const ModelId unseen = static_cast<const Query*>(hits->context)->unseen;
    if (unseen == no_model) return;
    for (unsigned i = 0; i < hits->N; ++i) {
        if (RTCHitN_instID(hits->hit, hits->N, i, 0) == unseen) hits->valid[i] = 0;
    }
}

/// Why the last call on this thread made no device.
inline std::string reason_without_device() {
    switch (rtcGetDeviceError(nullptr)) {
        case RTC_ERROR_OUT_OF_MEMORY:
            return ": there is too little memory";
        case RTC_ERROR_UNSUPPORTED_CPU:
            return ": it does not know this processor";
        default:
            return {};
    }
}

/// A component of a direction, to a nanoradian. Embree 3.13 loses all rays of a packet that share
/// their signs with one whose component is 1e-17 or so, as the cosine of a right angle comes out.
inline float component_apart_from_zero(float component) {
    constexpr float least = 1e-9F;
    return std::abs(component) < least ? std::copysign(least, component) : component;
}
inline glm::vec3 apart_from_zero(const glm::vec3& direction) {
    return {component_apart_from_zero(direction.x), component_apart_from_zero(direction.y),
            component_apart_from_zero(direction.z)};
}

inline DeviceHandle new_device() {
    // One thread: the commits after each move are small, and more threads only wait for each other.
    DeviceHandle device{rtcNewDevice("threads=1")};
    if (!device) throw std::runtime_error("Embree does not start" + reason_without_device());
    return device;
}

inline SceneHandle new_scene(RTCDevice device) {
    SceneHandle scene{rtcNewScene(device)};
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
    return scene;
}

}  // namespace scipd::sim
