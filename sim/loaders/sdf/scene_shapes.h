// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Turns the geometry of a surface into an object of the scene and reads the meshes and heightmaps
// that it names. It leaves out what it cannot read, and adds the reason to the draft. Any thread;
// one owner.
#pragma once

#include <set>
#include <string>

#include <glm/vec3.hpp>

#include "sim/loaders/file/scene_draft.h"
#include "sim/loaders/mesh/mesh_shelf.h"
#include "sim/loaders/parts/part.h"
#include "sim/loaders/resources/resources.h"
#include "sim/loaders/sdf/sdf_options.h"

namespace scipd::sim {

class SceneShapes {
  public:
    /// All of these must outlive this object.
    SceneShapes(const Resources& resources, const SdfOptions& options, SceneDraft& draft,
                MeshShelf& shelf)
        : resources_(resources), options_(options), draft_(draft), shelf_(shelf) {}

    /// `object` already has the pose of the surface; messages begin with `place`.
    void add(const SdfSurface& surface, Object object, const glm::dvec3& scale,
             const std::string& place);

    /// Adds the skin of an actor: a mesh, or a capsule if there is none.
    void add_skin(const SdfSurface& surface, Object object, const glm::dvec3& scale,
                  const std::string& place);

  private:
    void add_shape(const SdfSurface& surface, const PlacedShape& primitive, Object object,
                   const glm::dvec3& scale, const std::string& place);
    PlacedShape terrain_in(const NamedHeights& heights, const std::string& place);
    void add_mesh(const SdfSurface& surface, const NamedMesh& mesh, Object object,
                  const glm::dvec3& scale, const std::string& place);
    void leave_out_missing(const NamedFile& file, const std::string& place);

    const Resources& resources_;
    const SdfOptions& options_;
    SceneDraft& draft_;
    MeshShelf& shelf_;
    std::set<std::string> warned_kinds_;
    std::set<std::string> told_;  ///< missing downloads, by command
};

}  // namespace scipd::sim
