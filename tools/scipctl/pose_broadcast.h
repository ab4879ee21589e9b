// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Pose lines to all daemons that share a world, at its broker.
#pragma once

#include <istream>
#include <string>

#include "tools/scipctl/broker_session.h"

namespace scipd::tools {

/// Sends the lines of a text, one message for those of a hundredth of a second, until it ends.
/// Lines that name nothing are of `robot`. Throws ControlError if the broker cannot be reached or
/// lines were refused.
void broadcast_poses(const BrokerOptions& options, const std::string& robot, std::istream& lines);

}  // namespace scipd::tools
