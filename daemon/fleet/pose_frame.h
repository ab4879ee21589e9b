// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Pose lines in one message, and the steps of a time that many daemons share: all poses of an
// instant. A line that begins with # is a comment to all who read pose lines; that at the
// beginning names the sender or the step. Values; any thread.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/loaders/poses/pose_line.h"
#include "sim/time.h"

namespace scipd::daemon {

/// The first line of a frame: "# from NAME".
std::string frame_head(std::string_view sender);
/// Who has sent the frame; empty where it does not say.
std::string_view sender_of(std::string_view frame);
/// Without lines that are damaged.
std::vector<sim::PoseLine> poses_in(std::string_view frame);
/// One line with its end. It names the model, or else the robot.
void append_line(std::string& frame, const sim::PoseLine& line);

/// All poses of an instant; its first line is "# step 7 ...".
struct Step {
    int number = 0;
    sim::Time time{};  ///< the stamp that its poses have
    std::string from;  ///< who leads time
    std::string_view lines;
};

/// The first line, with its end.
std::string step_head(int number, sim::Time time, std::string_view from);
/// Returns nullopt if the first line is another one. The step lives as long as the text.
std::optional<Step> parse_step(std::string_view text);

/// The message of a daemon that has done a step.
std::string acknowledgement(const Step& step);
/// The number of the step, if it is one of that leader.
std::optional<int> acknowledged(std::string_view text, std::string_view leader);

}  // namespace scipd::daemon
