// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Many pose lines in one message. A line that begins with # is a comment to all who read pose
// lines; that at the beginning names the sender. Values; any thread.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sim/loaders/poses/pose_line.h"

namespace scipd::daemon {

/// The first line of a frame: "# from NAME".
std::string frame_head(std::string_view sender);
/// Who has sent the frame; empty where it does not say.
std::string_view sender_of(std::string_view frame);
/// Without lines that are damaged.
std::vector<sim::PoseLine> poses_in(std::string_view frame);
/// One line with its end. It names the model, or else the robot.
void append_line(std::string& frame, const sim::PoseLine& line);

}  // namespace scipd::daemon
