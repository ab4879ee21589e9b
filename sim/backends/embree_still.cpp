// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/embree_still.h"

#include <map>
#include <mutex>
#include <stdexcept>

#include "sim/backends/embree_geometry.h"

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

}  // namespace scipd::sim
