// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Sets any rate of a tty. It keeps nothing; any thread.
#pragma once

namespace scipd::tools {

/// Sets a tty to any rate in bits per second, also to 250000 and others that POSIX has no name for.
/// False: the tty's driver cannot do it; errno tells why.
[[nodiscard]] bool set_line_rate(int tty, int bits_per_second);

}  // namespace scipd::tools
