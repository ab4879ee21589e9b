// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace scipd::tools {

/// The options that all commands of scipctl share.
struct ControlOptions {
    std::string socket;
};

/// `scipctl status` and `scipctl sensors`. Here and below, the options must outlive the program's
/// parsing.
void add_status_commands(CLI::App& program, const ControlOptions& control);

/// `scipctl top`
void add_top_command(CLI::App& program, const ControlOptions& control);

/// `scipctl pose get|set|play|sources|stream`
void add_pose_commands(CLI::App& program, const ControlOptions& control);
void add_pose_play_command(CLI::App& pose, const ControlOptions& control);
void add_pose_sources_command(CLI::App& pose, const ControlOptions& control);
void add_pose_stream_command(CLI::App& pose, const ControlOptions& control);

/// `scipctl scene list|load|add|move|remove|medium|map|export`
void add_scene_commands(CLI::App& program, const ControlOptions& control);
void add_medium_command(CLI::App& scene, const ControlOptions& control);
void add_scene_file_commands(CLI::App& scene, const ControlOptions& control);

/// `scipctl fleet status|add|move|remove|forget`
void add_fleet_commands(CLI::App& program, const ControlOptions& control);

/// `scipctl reading ROBOT/SENSOR`
void add_reading_command(CLI::App& program, const ControlOptions& control);

/// `scipctl sensor set|add|remove ROBOT/SENSOR [KEY=VALUE...]`
void add_sensor_command(CLI::App& program, const ControlOptions& control);

/// `scipctl replay ROBOT/SENSOR seek|step|pause|play|speed`
void add_replay_command(CLI::App& program, const ControlOptions& control);

/// `scipctl truth ROBOT/SENSOR`
void add_truth_command(CLI::App& program, const ControlOptions& control);

/// `scipctl fault start|stop|list|log|kinds`
void add_fault_commands(CLI::App& program, const ControlOptions& control);

/// `scipctl scenario run|stop|status`
void add_scenario_command(CLI::App& program, const ControlOptions& control);

}  // namespace scipd::tools
