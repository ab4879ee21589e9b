// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipctl/model_options.h"

#include "tools/scipctl/pose_text.h"

namespace scipd::tools {

void add_model_options(CLI::App& command, ModelOptions& options, const std::string& file_help) {
    command.add_option("NAME", options.name, "the name of the new model")->required();
    command.add_option("FILE", options.file, file_help)
        ->required()
        ->check(CLI::Validator{[](const std::string& text) {
                                   return text == "-" || CLI::ExistingPath(text).empty()
                                              ? ""
                                              : "no such file: " + text +
                                                    " (- reads standard input)";
                               },
                               "PATH"});
    command.add_option("--pose", options.pose,
                       "X,Y,YAW or X,Y,Z,R,P,Y; default: the pose in its file");
    command.add_option("--scale", options.scale, "the scale of a mesh: 0.001 for millimetres")
        ->check(number_within(-1e6, 1e6));
    command.add_option("--material", options.material, "the material of a whole mesh");
    auto* const movable = command.add_flag(
        "--movable", options.movable, "make the model one movable body, whatever its file says");
    command
        .add_flag("--static", options.is_static, "make the model static, whatever its file says")
        ->excludes(movable);
    command.add_flag("--replace", options.replace, "replace the model of this name");
}

void put_model_options(const ModelOptions& options, ControlClient::Json& body) {
    if (options.scale) body["scale"] = *options.scale;
    if (!options.material.empty()) body["material"] = options.material;
    if (!options.pose.empty()) body["pose"] = pose_body({.pose = pose_of(options.pose)});
    if (options.movable || options.is_static) body["static"] = options.is_static;
}

sim::Pose pose_of(const std::string& text) {
    warn_of_degrees(text);
    if (const auto pose = parse_pose_text(text)) return *pose;
    throw CLI::ValidationError("\"" + text +
                               "\" is no pose: write X,Y,YAW or X,Y,Z,R,P,Y, such as 1,2,0");
}

}  // namespace scipd::tools
