// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The triangles of a scene of Assimp's, where its nodes put them, and its materials. Assimp's own
// step for this takes a transform near the identity for the identity: a scale of 1.009, a turn of
// half a degree and a move of 9 mm are lost. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <assimp/material.h>
#include <assimp/scene.h>
#include <glm/mat4x4.hpp>

#include "sim/loaders/mesh/mesh_file.h"
#include "sim/world/material.h"

namespace scipd::sim {

/// Removes all properties of the scene's materials but those that the functions below read. The
/// importer has no step for this.
void keep_what_matters(const aiScene& scene, const std::filesystem::path& file);

/// Empty where the file gives no name: Assimp makes one up then.
std::string name_of(const aiMaterial& material);

/// Only after keep_what_matters().
Appearance appearance_of(const aiMaterial& material);

/// All that the nodes show, one part for every material.
std::vector<MeshPart> parts_of(const aiScene& scene, const glm::dmat4& here_from_file);

/// What the name of a submesh means: a node, a mesh, or a node with all inside it. The first of
/// these that shows anything counts, as in Gazebo; empty if none does.
std::vector<MeshPart> submesh_of(const aiScene& scene, const std::string& name);

/// The names of nodes and meshes, for a message.
std::string names_in(const aiScene& scene);

}  // namespace scipd::sim
