// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Turns the geometry of a surface into an object of the scene and reads the meshes and heightmaps
// that it names. It leaves out what it cannot read, and adds the reason to the draft. Any thread;
// one owner.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>

#include <glm/vec3.hpp>

#include "sim/loaders/mesh/mesh_shelf.h"
#include "sim/loaders/sdf/resources.h"
#include "sim/loaders/sdf/scene_draft.h"
#include "sim/loaders/sdf/sdf_file.h"
#include "sim/loaders/sdf/sdf_options.h"
#include "sim/loaders/sdf/sdf_shape.h"
#include "sim/loaders/sdf/sdf_surface.h"

namespace scipd::sim {

class SceneShapes {
  public:
    /// All of these must outlive this object. `file` is the file that the user asked for.
    SceneShapes(const SdfFile& read, const std::filesystem::path& file, const Resources& resources,
                const SdfOptions& options, SceneDraft& draft, MeshShelf& shelf)
        : read_(read),
          file_(file),
          resources_(resources),
          options_(options),
          draft_(draft),
          shelf_(shelf) {}

    /// `object` already has the pose of the surface; messages begin with `place`.
    void add(const SdfSurface& surface, Object object, const glm::dvec3& scale,
             const std::string& place);

    /// Adds the skin of an actor: a mesh, or a capsule if there is none.
    void add_skin(const SdfSurface& surface, Object object, const glm::dvec3& scale,
                  const std::string& place);

  private:
    void add_shape(const SdfSurface& surface, Object object, const glm::dvec3& scale,
                   const std::string& place);
    std::optional<PlacedShape> shape_of(const sdf::Geometry& geometry, const std::string& place);
    void add_mesh(const SdfSurface& surface, const sdf::Mesh& mesh, Object object,
                  const glm::dvec3& scale, const std::string& place);
    void leave_out_missing(const sdf::Mesh& mesh, const std::filesystem::path& folder,
                           const std::string& place);
    /// Where a relative URI in this element starts.
    [[nodiscard]] std::filesystem::path folder_of(const sdf::ElementPtr& element) const;

    const SdfFile& read_;
    const std::filesystem::path& file_;
    const Resources& resources_;
    const SdfOptions& options_;
    SceneDraft& draft_;
    MeshShelf& shelf_;
    std::set<std::string> warned_kinds_;
    std::set<std::string> told_;  ///< missing downloads, by command
};

}  // namespace scipd::sim
