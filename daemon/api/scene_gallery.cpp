// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/api/scene_gallery.h"

namespace scipd::daemon {

void SceneGallery::objects(const sim::SharedScene& scene,
                           std::function<void(const SharedObjects&)> take) {
    if (latest_ && latest_->are_of(scene)) return take(latest_);
    use(scene, [take = std::move(take)](const SharedObjects& objects) mutable {
        return [objects, take = std::move(take)] { take(objects); };
    });
}

void SceneGallery::triangles(const sim::SharedScene& scene, std::string hash,
                             std::function<void(std::optional<std::string>)> take) {
    use(scene, [hash = std::move(hash), take = std::move(take)](const auto& objects) mutable {
        // Shared, since a function is copied and the bytes are many.
        auto bytes = std::make_shared<std::optional<std::string>>(objects->triangles(hash));
        return [bytes, take = std::move(take)] { take(std::move(*bytes)); };
    });
}

// What is to be called on the I/O thread is moved back there, and so is destroyed there.
void SceneGallery::use(const sim::SharedScene& scene, Use use) {
    aside_([this, scene, use = std::move(use)]() mutable -> Worker::Work {
        SharedObjects known = latest_ && latest_->are_of(scene) ? latest_ : nullptr;
        return [this, scene, known, use = std::move(use)]() mutable -> Worker::Finish {
            const SharedObjects objects =
                known ? known : std::make_shared<const SceneObjects>(scene);
            return [this, objects, finish = use(objects)] {
                latest_ = objects;
                finish();
            };
        };
    });
}

}  // namespace scipd::daemon
