// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a daemon is called among those that share a world. Any thread.
#pragma once

#include <string>

namespace scipd::daemon {

std::string host_name();

/// HOST-PID, for a daemon that nobody has given a name.
std::string usual_name();

/// Another one each time: no two clients of a broker may have the same, since it would throw the
/// older one out.
std::string new_instance();

}  // namespace scipd::daemon
