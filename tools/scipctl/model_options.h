// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What people say of a model that is to be added, at one daemon or at all that share a world.
#pragma once

#include <optional>
#include <string>

#include "sim/world/pose.h"
#include "tools/control_client.h"
#include "tools/options.h"

namespace scipd::tools {

struct ModelOptions {
    std::string name;
    std::string file;
    std::string pose;
    std::string material;
    std::optional<double> scale;
    bool movable = false;
    bool is_static = false;
    bool replace = false;
};

/// `options` must live as long as the command.
void add_model_options(CLI::App& command, ModelOptions& options, const std::string& file_help);

/// Puts all but name, file and replace into the body of POST /scene/models. Throws
/// CLI::ValidationError for a pose that is none.
void put_model_options(const ModelOptions& options, ControlClient::Json& body);

/// Throws CLI::ValidationError.
[[nodiscard]] sim::Pose pose_of(const std::string& text);

}  // namespace scipd::tools
