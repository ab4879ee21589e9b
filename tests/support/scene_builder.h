// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Builds scenes in a few words, for tests and benchmarks.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "sim/world/anchor.h"
#include "sim/world/scene.h"

namespace scipd::sim {

class SceneBuilder {
  public:
    SceneBuilder() = default;
    /// All poses that follow are relative to this frame.
    explicit SceneBuilder(const Pose& world_from_here) : world_from_here_(world_from_here) {}

    /// Adds a model that never moves, with one object.
    SceneBuilder& add(Shape shape, const Pose& here_from_object, MaterialId material = 0) {
        begin_model(false, here_from_object);
        return with(std::move(shape), Pose{}, material);
    }

    /// Adds a model that can move. with() adds its objects.
    SceneBuilder& movable(const Pose& here_from_model) {
        return begin_model(true, here_from_model);
    }

    /// Adds an object to the latest model.
    SceneBuilder& with(Shape shape, const Pose& model_from_object, MaterialId material = 0) {
        const auto model = static_cast<ModelId>(scene_.models.size() - 1);
        const std::string name = "object " + std::to_string(scene_.objects.size());
        scene_.objects.push_back({name, model, model_from_object, std::move(shape), material});
        while (scene_.materials.size() <= material) {
            scene_.materials.push_back({"material " + std::to_string(scene_.materials.size())});
        }
        return *this;
    }

    [[nodiscard]] SharedScene build() const {
        auto scene = std::make_shared<Scene>(scene_);
        scene->anchor_m = anchor_of(*scene);
        return scene;
    }

  private:
    SceneBuilder& begin_model(bool movable, const Pose& here_from_model) {
        const std::string name = "model " + std::to_string(scene_.models.size());
        scene_.models.push_back({name, movable, world_from_here_ * here_from_model});
        return *this;
    }

    Pose world_from_here_;
    Scene scene_;
};

}  // namespace scipd::sim
