// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reports and counts each line that is refused, here or by scipd, and goes on with the next.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <iostream>
#include <istream>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "daemon/fleet/pose_frame.h"
#include "sim/loaders/poses/pose_line.h"
#include "tools/control_client.h"
#include "tools/options.h"
#include "tools/scipctl/broker_session.h"
#include "tools/scipctl/names.h"
#include "tools/scipctl/pose_broadcast.h"
#include "tools/scipctl/pose_text.h"
#include "tools/scipctl/scipctl_commands.h"

namespace scipd::tools {
namespace {

using daemon::Topic;

/// Leads the time of all daemons that share a world and work in lockstep: the stamps of pose lines
/// are the time. It goes on when each of them has done the step before.
class TimeLeader {
  public:
    TimeLeader(const BrokerOptions& options, double patience_s)
        : session_(options), patience_(std::int64_t(patience_s * 1000.0)) {
        (void)session_.kept();
        session_.listen_to_acks();
    }

    /// Lines of a later stamp send the step before.
    void take(const sim::PoseLine& line) {
        if (time_ && *line.time != *time_) send();
        time_ = line.time;
        daemon::append_line(lines_, line);
    }

    /// Returns when all who take part have done it.
    void send() {
        if (!time_) return;
        ++number_;
        session_.publish(Topic::Kind::time, {},
                         daemon::step_head(number_, *time_, session_.name()) + lines_);
        lines_.clear();
        if (session_.link().run_until([&] { return missing().empty(); }, patience_)) return;
        if (!session_.link().connected())
            throw ControlError(0, "the broker is lost: " + session_.link().trouble());
        for (const std::string& name : missing()) {
            std::cerr << "daemon " << name << " does not acknowledge step " << number_
                      << "; it is left out\n";
            left_out_.insert(name);
        }
    }

  private:
    /// The daemons that have not done the step, but for lost ones and those on the wall clock.
    std::vector<std::string> missing() {
        std::vector<std::string> names;
        for (const auto& [name, note] : session_.kept_now().daemons) {
            tell_if_lost(name, note);
            if (note.lost || !note.in_steps || left_out_.contains(name)) continue;
            if (session_.acknowledged(name) < number_) names.push_back(name);
        }
        return names;
    }

    void tell_if_lost(const std::string& name, const daemon::DaemonNote& note) {
        if (!note.lost) {
            lost_.erase(name);
        } else if (lost_.insert(name).second && number_ > 1) {
            std::cerr << "daemon " << name << " is lost; it is left out\n";
        }
    }

    BrokerSession session_;
    const std::chrono::milliseconds patience_;
    int number_ = 0;
    std::optional<sim::Time> time_;
    std::string lines_;
    std::set<std::string> left_out_;
    std::set<std::string> lost_;
};

/// Sends the lines of a text, one message for those of one stamp, until it ends. Lines that name
/// nothing are of `robot`. A daemon that acknowledges no step for so long is named and left out.
/// Throws ControlError if the broker cannot be reached or lines were refused.
void lead_time(const BrokerOptions& options, const std::string& robot, double patience_s,
               std::istream& lines) {
    TimeLeader leader(options, patience_s);
    for_each_line_for_many(lines, robot, [&](const sim::PoseLine& line) -> sim::Expected<> {
        if (!line.time) return sim::refuse("t is missing: time is that of the poses");
        leader.take(line);
        return {};
    });
    leader.send();
}

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
