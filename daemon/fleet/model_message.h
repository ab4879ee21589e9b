// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the broker keeps of a model that was added, changed or taken away: the body with which the
// control API adds one, or that it is gone. Values; any thread.
#pragma once

#include <string>
#include <string_view>

#include "daemon/world/scene_edit.h"
#include "sim/expected.h"

namespace scipd::daemon {

/// As the control API takes it, and it takes the place of a model of the same name.
std::string text_of(const AddModel& edit);

/// That a model of the base world is gone. Nothing need be said of one that was added.
inline constexpr std::string_view gone = R"({"remove":true})";

/// The edit that makes a world have it so. An empty text takes the model away.
sim::Expected<SceneEdit> parse_model_message(const std::string& name, const std::string& text);

}  // namespace scipd::daemon
