// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Each pose is sent at its own instant, counted from the start and not from the pose before, so
// that delays do not add up.
#include <chrono>
#include <iostream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "sim/loaders/poses/trajectory_file.h"
#include "tools/control_client.h"
#include "tools/options.h"
#include "tools/scipctl/names.h"
#include "tools/scipctl/pose_text.h"
#include "tools/scipctl/scipctl_commands.h"

namespace scipd::tools {
namespace {

struct PlayOptions {
    std::string file;
    std::string robot;
    double speed = 1.0;
    bool loop = false;
};

/// The stamp of the first pose. In lockstep stamps are the time, so they must be the same each time
/// the file is played. Otherwise the host's clock gives stamps that always grow.
sim::Time first_stamp(ControlClient& client, const std::vector<sim::TimedPose>& poses) {
    const auto clock = client.get("/status").value("clock", std::string("wall"));
    if (clock == "poses") return poses.front().time;
    return std::chrono::system_clock::now().time_since_epoch();
}

void play(const ControlOptions& control, const PlayOptions& options) {
    const auto [poses, warnings] = sim::load_trajectory(options.file);
    for (const std::string& warning : warnings)
        std::cerr << warning << '\n';
    ControlClient client(control.socket);
    const std::string path = pose_path(choose_robot(client, options.robot));
    const sim::Time stamp = first_stamp(client, poses);
    const auto start = std::chrono::steady_clock::now();
    const sim::Time lap = sim::lap_time(poses);
    sim::Time laps{};
    do {
        for (const sim::TimedPose& pose : poses) {
            const std::chrono::duration<double, std::nano> played =
                (laps + pose.time - poses.front().time) / options.speed;
            const auto offset = std::chrono::round<sim::Time>(played);
            std::this_thread::sleep_until(start + offset);
            client.put(path, pose_body({.time = stamp + offset, .pose = pose.pose}));
        }
        laps += lap;
    } while (options.loop && lap > sim::Time{});
}

}  // namespace

void add_pose_play_command(CLI::App& pose, const ControlOptions& control) {
    auto* const command = pose.add_subcommand("play", "move a robot along a recorded trajectory");
    const auto options = std::make_shared<PlayOptions>();
    command
        ->add_option("FILE", options->file,
                     "a trajectory: TUM (a line t x y z qx qy qz qw for each pose), EuRoC or KITTI "
                     "ground truth, or CSV with a header")
        ->required()
        ->check(CLI::ExistingFile);
    command->add_option("--robot", options->robot, "the robot; not needed if there is only one");
    command->add_option("--speed", options->speed, "2 plays twice as fast")
        ->check(number_within(1e-3, 1e3))
        ->capture_default_str();
    command->add_flag("--loop", options->loop, "play it again and again, until Ctrl-C");
    command->callback([&control, options] { play(control, *options); });
    command->footer("Example:\n  scipctl pose play scenes/rescue_maze.tum --robot rescue --loop");
}

}  // namespace scipd::tools
