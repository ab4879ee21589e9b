// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reports and counts each line that is refused, here or by scipd, and goes on with the next.
#include <cstdint>
#include <iostream>
#include <memory>
#include <string>
#include <utility>

#include "sim/loaders/poses/pose_line.h"
#include "tools/control_client.h"
#include "tools/options.h"
#include "tools/scipctl/names.h"
#include "tools/scipctl/pose_broadcast.h"
#include "tools/scipctl/pose_text.h"
#include "tools/scipctl/scipctl_commands.h"
#include "tools/scipctl/time_leader.h"

namespace scipd::tools {
namespace {

struct StreamOptions {
    std::string robot;
    BrokerOptions broker;
    bool lockstep = false;
    double patience_s = 10.0;
};

class PoseForwarder {
  public:
    PoseForwarder(ControlClient& client, std::string robot)
        : client_(client), robot_(std::move(robot)) {}

    /// Throws ControlError.
    void forward(const std::string& text) {
        const auto line = sim::parse_pose_line(text);
        if (!line) throw ControlError(400, line.error().why);
        client_.put(path_of(*line), pose_body(*line));
    }

  private:
    std::string path_of(const sim::PoseLine& line) {
        if (!line.model.empty()) return "/scene/models/" + path_segment(line.model) + "/pose";
        if (!line.robot.empty()) return pose_path(line.robot);
        if (path_.empty()) path_ = pose_path(choose_robot(client_, robot_));
        return path_;
    }

    ControlClient& client_;
    const std::string robot_;
    std::string path_;  ///< of the lines that name no robot; empty before the first
};

void stream(const ControlOptions& control, const StreamOptions& options) {
    ControlClient client(control.socket);
    PoseForwarder forwarder(client, options.robot);
    std::uint64_t number = 0;
    std::uint64_t refused = 0;
    for (std::string line; std::getline(std::cin, line);) {
        ++number;
        if (sim::says_nothing(line)) continue;
        try {
            forwarder.forward(line);
        } catch (const ControlError& error) {
            if (error.status() == 0) throw;
            ++refused;
            std::cerr << "line " << number << ": " << error.what() << '\n';
        }
    }
    if (refused == 0) return;
    throw ControlError(
        0, std::to_string(refused) + " of " + std::to_string(number) + " lines were refused");
}

}  // namespace

void add_pose_stream_command(CLI::App& pose, const ControlOptions& control) {
    auto* const command = pose.add_subcommand("stream", "send pose lines from standard input");
    const auto options = std::make_shared<StreamOptions>();
    command->add_option("--robot", options->robot, "robot of the lines that name none");
    add_broker_options(*command, options->broker,
                       "send them to all daemons that share this world, through its broker");
    auto* const lockstep = command->add_flag("--lockstep", options->lockstep,
                                             "drive the time of the daemons with clock: poses; the "
                                             "next step waits until all have done the last");
    lockstep->needs("--to");
    command
        ->add_option("--patience", options->patience_s,
                     "timeout in seconds; a daemon that has not done a step by then is left out")
        ->needs(lockstep)
        ->check(number_within(0.1, 3600.0))
        ->capture_default_str();
    command->callback([&control, options] {
        if (options->broker.to.empty()) return stream(control, *options);
        if (options->lockstep)
            return lead_time(options->broker, options->robot, options->patience_s, std::cin);
        broadcast_poses(options->broker, options->robot, std::cin);
    });
    command->footer(
        "A line is {\"robot\":\"rescue\",\"t\":12.345,\"xyz\":[1,2,0],\"q\":[0,0,0,1]},\n"
        "or t x y z qx qy qz qw. robot and t may be left out, and rpy may stand for q.\n"
        "Example:\n"
        "  my_simulator | scipctl pose stream\n"
        "  my_simulator | scipctl pose stream --to mqtt://127.0.0.1:1883/hall");
}

}  // namespace scipd::tools
