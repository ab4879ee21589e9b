// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <iostream>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "sim/loaders/poses/pose_line.h"
#include "sim/text/text_number.h"
#include "tools/control_client.h"
#include "tools/scipctl/model_options.h"
#include "tools/scipctl/names.h"
#include "tools/scipctl/pose_text.h"
#include "tools/scipctl/scipctl_commands.h"

namespace scipd::tools {
namespace {

struct GetOptions {
    std::string robot;
    bool json = false;
};

/// The last word is the pose; a robot may come before it.
struct SetOptions {
    std::vector<std::string> words;
};

void get_pose(const ControlOptions& control, const GetOptions& options) {
    ControlClient client(control.socket);
    const auto document = client.get(pose_path(choose_robot(client, options.robot)));
    if (options.json) {
        std::cout << json_text(document) << '\n';
        return;
    }
    // The answer is a pose line.
    const auto line = sim::pose_line_in(document);
    if (!line) throw ControlError(0, "scipd's answer is no pose: " + line.error().why);
    std::cout << pose_text(line->pose) << '\n';
}

bool could_be_robot(const std::string& word) {
    return !word.empty() && word.find(',') == word.npos && !sim::parse_number(word);
}

void set_pose(const ControlOptions& control, const SetOptions& options) {
    if (options.words.size() > 2) {
        std::string pose;
        for (const std::string& word : options.words) {
            if (sim::parse_number(word)) pose += (pose.empty() ? "" : ",") + word;
        }
        throw WrongInput("write the pose as one word: " + (pose.empty() ? "1,2,0" : pose));
    }
    ControlClient client(control.socket);
    const std::string& last = options.words.back();
    if (options.words.size() == 1 && could_be_robot(last))
        throw WrongInput("add the pose of " + choose_robot(client, last) + ", such as 1,2,0");
    const sim::Pose pose = pose_of(last);
    const std::string wanted = options.words.size() == 2 ? options.words.front() : std::string();
    client.put(pose_path(choose_robot(client, wanted)), pose_body({.pose = pose}));
}

void add_get_command(CLI::App& pose, const ControlOptions& control) {
    auto* const command = pose.add_subcommand("get", "print the pose of a robot as X,Y,Z,R,P,Y");
    const auto options = std::make_shared<GetOptions>();
    command->add_option("ROBOT", options->robot, "the robot; not needed if there is only one");
    command->add_flag("--json", options->json, "as a pose line");
    command->callback([&control, options] { get_pose(control, *options); });
}

void add_set_command(CLI::App& pose, const ControlOptions& control) {
    auto* const command = pose.add_subcommand("set", "set the pose of a robot");
    const auto options = std::make_shared<SetOptions>();
    command->add_option("POSE", options->words, "X,Y,YAW or X,Y,Z,R,P,Y in metres and radians")
        ->option_text("[ROBOT] POSE")
        ->required()
        ->expected(1, 7);  // to advise on 1 2 0
    command->callback([&control, options] { set_pose(control, *options); });
    command->footer(
        "Examples:\n"
        "  scipctl pose set 1.5,2,3.14159\n"
        "  scipctl pose set rescue 1.5,2,0,0,0,3.14159");
}

}  // namespace

void add_pose_commands(CLI::App& program, const ControlOptions& control) {
    auto* const pose = program.add_subcommand("pose", "show or set the poses of robots");
    pose->require_subcommand(1);
    add_get_command(*pose, control);
    add_set_command(*pose, control);
    add_pose_play_command(*pose, control);
    add_pose_sources_command(*pose, control);
    add_pose_stream_command(*pose, control);
}

}  // namespace scipd::tools
