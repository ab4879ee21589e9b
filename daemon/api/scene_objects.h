// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The objects of a scene as a page draws them: their triangles, and what is told of each but where
// it is. Objects of the same geometry share their triangles. It does not keep the scene. Immutable;
// any thread.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/world/scene.h"

namespace scipd::daemon {

class SceneObjects {
  public:
    explicit SceneObjects(const sim::SharedScene& scene);

    [[nodiscard]] bool are_of(const sim::SharedScene& scene) const {
        return scene_.lock() == scene;
    }
    [[nodiscard]] std::size_t size() const { return texts_.size(); }
    /// What its triangles are named by.
    [[nodiscard]] const std::string& hash(sim::ObjectId id) const { return *hashes_[id]; }
    /// The JSON of an object without its last brace.
    [[nodiscard]] const std::string& text(sim::ObjectId id) const { return texts_[id]; }

    /// The triangles that objects name by this hash, as a page reads them: little-endian the
    /// number magic, the numbers of vertices and of triangles, all vertices as x, y, z in float,
    /// all triangles as three indices. Nothing: there are none, or the scene is gone.
    [[nodiscard]] std::optional<std::string> triangles(std::string_view hash) const;

    static constexpr std::uint32_t magic = 0x314D4353;  ///< "SCM1"

  private:
    std::weak_ptr<const sim::Scene> scene_;
    std::vector<std::string> texts_;                               ///< by ObjectId
    std::map<std::string, sim::ObjectId, std::less<>> with_hash_;  ///< one of those who share it
    std::vector<const std::string*> hashes_;  ///< by ObjectId, the keys of with_hash_
};

}  // namespace scipd::daemon
