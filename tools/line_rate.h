// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The rate of a tty, whichever it is. Nothing is kept; any thread.
#pragma once

namespace scipd::tools {

/// Sets a tty to any rate, in bits per second, also to 250000 and others that POSIX has no name
/// for. False: its driver cannot, and errno tells why.
[[nodiscard]] bool set_line_rate(int tty, int bits_per_second);

}  // namespace scipd::tools
