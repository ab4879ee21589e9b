// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The bodies of requests that change the scene. Any thread; nothing shared.
#pragma once

#include <string>

#include "daemon/world/scene_edit.h"
#include "sim/expected.h"

namespace scipd::daemon {

/// {"file":"other.sdf"}
sim::Expected<LoadWorld> parse_load_world(const std::string& body);

/// {"name":"crate", "sdf":"<model ..>" or "file":"crate.sdf" or "mesh":"crate.stl", with "scale"
/// and "material" where it is a mesh, "pose":{"xyz","rpy" or "q"}, "static":true, "replace":true}
sim::Expected<AddModel> parse_add_model(const std::string& body);

/// Reads {"material": NAME} for this model.
sim::Expected<SetMaterial> parse_set_material(const std::string& model, const std::string& body);

}  // namespace scipd::daemon
