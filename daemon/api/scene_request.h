// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The bodies of requests that change the scene. Any thread; nothing shared.
#pragma once

#include <string>
#include <variant>

#include "daemon/world/scene_edit.h"

namespace scipd::daemon {

/// Why a body is refused.
struct BodyFault {
    std::string sentence;
    std::string field;  ///< empty: the whole
};

/// {"file":"other.sdf"}
std::variant<LoadWorld, BodyFault> parse_load_world(const std::string& body);

/// {"name":"crate", "sdf":"<model ..>" or "file":"crate.sdf" or "mesh":"crate.stl", with "scale"
/// and "material" where it is a mesh, "pose":{"xyz","rpy" or "q"}, "static":true, "replace":true}
std::variant<AddModel, BodyFault> parse_add_model(const std::string& body);

}  // namespace scipd::daemon
