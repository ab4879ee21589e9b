// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The bodies of requests that change the scene, and the media of a world as JSON. Any thread;
// nothing shared.
#pragma once

#include <string>
#include <vector>

#include "daemon/api/documents.h"
#include "daemon/world/scene_edit.h"
#include "sim/expected.h"
#include "sim/world/medium.h"

namespace scipd::daemon {

/// {"file":"other.sdf"}
sim::Expected<LoadWorld> parse_load_world(const std::string& body);

/// {"name":"crate", "sdf":"<model ..>" or "file":"crate.sdf" or "mesh":"crate.stl", with "scale"
/// and "material" where it is a mesh, "pose":{"xyz","rpy" or "q"}, "static":true, "replace":true}
sim::Expected<AddModel> parse_add_model(const std::string& body);

/// Reads {"material": NAME} for this model.
sim::Expected<SetMaterial> parse_set_material(const std::string& model, const std::string& body);

/// [{"kind":"fog","visibility_m":20,"name":"mist","box":{"from":[0,0,0],"to":[2,2,3]}}, ..], in the
/// words of the configuration.
sim::Expected<std::vector<sim::Medium>> parse_media(const std::string& body);

/// The document that parse_media() reads.
Json media_document(const std::vector<sim::Medium>& media);

}  // namespace scipd::daemon
