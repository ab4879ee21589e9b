// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Makes what pages draw of the scene, aside, so that no scan waits for a world of a million
// triangles. It keeps what it made last. Lives on the I/O thread.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "daemon/api/scene_objects.h"
#include "daemon/world/worker.h"
#include "sim/world/scene.h"

namespace scipd::daemon {

using SharedObjects = std::shared_ptr<const SceneObjects>;

class SceneGallery {
  public:
    /// Has a worker do it.
    using Aside = std::function<void(Worker::Begin)>;

    explicit SceneGallery(Aside aside) : aside_(std::move(aside)) {}

    void objects(const sim::SharedScene& scene, std::function<void(const SharedObjects&)> take);
    /// As SceneObjects::triangles().
    void triangles(const sim::SharedScene& scene, std::string hash,
                   std::function<void(std::optional<std::string>)> take);

  private:
    /// Called aside; what it returns is called on the I/O thread.
    using Use = std::function<Worker::Finish(const SharedObjects&)>;
    void use(const sim::SharedScene& scene, Use use);

    Aside aside_;
    SharedObjects latest_;
};

}  // namespace scipd::daemon
