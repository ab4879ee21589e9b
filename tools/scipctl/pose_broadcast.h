// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Pose lines to all daemons that share a world, at its broker.
#pragma once

#include <functional>
#include <istream>
#include <string>

#include "sim/expected.h"
#include "sim/loaders/poses/pose_line.h"
#include "tools/scipctl/broker_session.h"

namespace scipd::tools {

/// Reads pose lines for many daemons until the text ends. Lines that name nothing are of `robot`.
/// What is refused is told. Throws ControlError at the end if anything was.
void for_each_line_for_many(std::istream& lines, const std::string& robot,
                            const std::function<sim::Expected<>(const sim::PoseLine&)>& take);

/// Sends the lines of a text, one message for those of a hundredth of a second, until it ends.
/// Lines that name nothing are of `robot`. Throws ControlError if the broker cannot be reached or
/// lines were refused.
void broadcast_poses(const BrokerOptions& options, const std::string& robot, std::istream& lines);

}  // namespace scipd::tools
