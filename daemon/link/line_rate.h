// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads the rate of a tty, also one that POSIX has no name for. Keeps nothing; any thread.
#pragma once

namespace scipd::daemon {

/// The rate that a tty is set to, in bits per second: also 250000 and others that POSIX has no name
/// for. Either end of a pseudo-terminal will do.
[[nodiscard]] int line_rate(int tty);

}  // namespace scipd::daemon
